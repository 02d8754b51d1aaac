// An accuracy that is asked for, and got.
#include "app/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <tuple>

#include "app/accuracy_end.hpp"
#include "base/errors.hpp"
#include "base/stopwatch.hpp"
#include "gmsh/write_msh.hpp"
#include "results/error_report.hpp"
#include "support/messages.hpp"
#include "support/scene_to_accuracy.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Against an exact pressure at the vertices that count: the part of them inside their bars, and the error in L2,
// relative.
struct Got {
  double inside = 0, error = 0;
};

Got got(const Results& r, const std::function<double(const Vec2&)>& exact) {
  Got g;
  double square = 0, size = 0, count = 0;
  const PressureEstimate& e = r.estimate->pressures[0];
  for (Eigen::Index i = 0; i < e.line.p.size(); ++i) {
    if (!e.line.loaded[i] || e.excluded[i]) continue;
    const double p = exact(e.line.position[i]), off = std::abs(e.fitted.at(e.line.s(i)).value_or(e.line.p(i)) - p);
    g.inside += off <= e.bar(i);
    ++count;
    square += off * off * e.line.h(i);
    size += p * p * e.line.h(i);
  }
  g.inside /= count;
  g.error = std::sqrt(square / size);
  return g;
}

TEST(Accuracy, OfHertzIsReachedWithItsBars) {
  const double a = 0.0100757, p0 = 581.290e6;  // geo/hertz.toml; the finite bodies change them by 1e-4
  const auto hertz = [&](const Vec2& x) { return p0 * std::sqrt(std::max(0.0, 1 - x.x() * x.x() / (a * a))); };
  for (const auto& [asked, unknowns] : {std::pair{"5%", 9000}, {"1%", 12000}, {"0.2%", 13000}}) {
    const auto r = solve_to_accuracy(scene_to_accuracy("hertz", asked));
    ASSERT_TRUE(r && r->accuracy->reached()) << asked;
    EXPECT_EQ(r->status, Status::solved);
    const Got g = got(*r, hertz);
    EXPECT_LE(g.error, r->accuracy->asked) << asked;
    EXPECT_LE(g.error, 1.2 * r->estimate->pressure()) << asked;  // the formula itself is off by 1e-4
    EXPECT_GE(g.inside, 0.95) << asked;
    EXPECT_LE(free_unknowns(*r), unknowns) << asked;
    EXPECT_LE(r->accuracy->solves.size(), 5u) << asked;
  }
}

TEST(Accuracy, OfRingsIsTheConstantPressure) {
  const auto r = solve_to_accuracy(scene_to_accuracy("rings", "0.1%"));
  ASSERT_TRUE(r && r->accuracy->reached());
  double mean = 0;
  for (const ContactNode& n : r->recovery.contacts[0].multiplier.nodes)
    mean += n.p / double(r->recovery.contacts[0].multiplier.nodes.size());
  const Got g = got(*r, [&](const Vec2&) { return mean; });
  EXPECT_EQ(g.inside, 1);
  EXPECT_LE(g.error, 1e-3);
}

TEST(Accuracy, LeavesOutSingularPointsAndSaysWhere) {
  const auto r = solve_to_accuracy(scene_to_accuracy("tent_b", "1%"));
  ASSERT_TRUE(r && r->accuracy->reached());
  const PressureEstimate& e = r->estimate->pressures[0];
  ASSERT_EQ(e.singular.size(), 3u);  // both ends and the kink
  for (Eigen::Index i = 0; i < e.line.p.size(); ++i)
    EXPECT_EQ(e.excluded[i] != 0,
              std::min({(e.line.position[i] - Vec2(0, 0.2)).norm(), (e.line.position[i] - Vec2(0.4, 0.4)).norm(),
                        (e.line.position[i] - Vec2(0.8, 0.2)).norm()}) < e.left_out[0]);
  const auto wider = solve_to_accuracy(scene_to_accuracy("tent_b", "1%", {{"accuracy.exclude", "0.2"}}));
  EXPECT_NEAR(wider->estimate->pressures[0].left_out[0], 2 * e.left_out[0], 1e-6);
}

TEST(Accuracy, NeedsASecondSolveToConfirmAFirstThatIsNotThreeTimesAsGood) {
  AccuracyReport report{.asked = 0.01, .excluded = 0.1, .solves = {{100, 0.009, 0}}, .reason = {}};
  EXPECT_FALSE(report.reached());
  report.solves.push_back({200, 0.009, 0});
  EXPECT_TRUE(report.reached());
  report.solves = {{100, 0.003, 0}};
  EXPECT_TRUE(report.reached());
  report.solves = {{100, std::nan(""), 0}};
  EXPECT_FALSE(report.reached());
  report.solves = {{100, 0, 0, true}};  // of contact between two vertices
  EXPECT_FALSE(report.reached());
  report.solves.push_back({200, 0.009, 0, true});
  EXPECT_TRUE(report.reached());
}

TEST(Accuracy, ThatIsNotReachedHasAStatusOfItsOwnAndSaysWhy) {
  const auto r = solve_to_accuracy(scene_to_accuracy("hertz", "0.1%", {{"accuracy.unknowns_max", "3000"}}));
  ASSERT_TRUE(r);
  EXPECT_FALSE(r->accuracy->reached());
  EXPECT_EQ(r->status, Status::accuracy_not_reached);
  EXPECT_EQ(r->accuracy->reason, "unknowns_max");
  EXPECT_LE(free_unknowns(*r), 3300);
  EXPECT_GE(free_unknowns(*r), 2000);
}

TEST(Accuracy, TakesNoMoreSolvesThanItMay) {
  const auto r = solve_to_accuracy(scene_to_accuracy("hertz", "0.1%", {{"accuracy.solves_max", "2"}}));
  ASSERT_TRUE(r);
  EXPECT_EQ(r->accuracy->solves.size(), 2u);
  EXPECT_EQ(r->accuracy->reason, "2 solves");
  EXPECT_EQ(r->status, Status::accuracy_not_reached);
  EXPECT_NE(largest_error(*r).find("of 'cylinder_foot' on 'block_top'"), std::string::npos) << largest_error(*r);
}

void expect_best_of_its_answers(const Results& r) {
  EXPECT_FALSE(r.accuracy->reached());
  const std::vector<AccuracyReport::Solve>& solves = r.accuracy->solves;
  ASSERT_GE(solves.size(), 3u);
  const AccuracyReport::Solve& best = solves[std::size_t(r.accuracy->answer()) - 1];
  EXPECT_EQ(r.estimate->pressure(), best.estimated);
  EXPECT_EQ(free_unknowns(r), best.unknowns);
  for (const AccuracyReport::Solve& solve : solves)
    EXPECT_LE(best.estimated, (&solve == solves.data() ? 3 : 1) * solve.estimated);
}

// A roller pushed along a plate: the finer the mesh, the shorter the contact that it slides along, until the slide is
// more than small displacements bear.
TEST(Accuracy, ThatIsNotReachedHasTheBestOfItsAnswersWhateverTheirChecksSay) {
  const TemporaryFolder folder;
  folder.write("roller.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-8, -8, 0, 16, 8}; Disk(2) = {0, 4, 0, 4}; Rectangle(3) = {-5, 4, 0, 10, 5};
BooleanDifference(4) = { Surface{2}; Delete; }{ Surface{3}; Delete; };
Physical Surface("plate") = {1}; Physical Surface("roller") = {4};
of_roller() = Abs(Boundary{ Surface{4}; });
Physical Curve("ground") = {1}; Physical Curve("top") = {3};
Physical Curve("rim") = {of_roller(0)}; Physical Curve("head") = {of_roller(1)};
)");
  const std::filesystem::path scene = folder.write("roller.toml", R"(mesh.file = "roller.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies."*" = "steel"
boundary = [ { on = "ground", displacement = { x = 0, y = 0 } },
             { on = "head", rigid = { x = 0.081, rotation = 0, force = [0, -1000] } } ]
contact = [ { between = ["rim", "top"] } ]
accuracy = { value = "0.01%" }
)");
  const auto second = solve_to_accuracy(read_scene(scene, {{"accuracy.solves_max", "2"}}));
  const auto fourth = solve_to_accuracy(read_scene(scene, {{"accuracy.solves_max", "4"}}));
  ASSERT_TRUE(second && fourth);
  EXPECT_EQ(second->status, Status::accuracy_not_reached);
  EXPECT_EQ(fourth->status, Status::check_failed);
  expect_best_of_its_answers(*fourth);
}

// p is constant: what is estimated is round-off, which rises with the unknowns.
TEST(Accuracy, ThatIsNotReachedHasTheBestOfItsAnswers) {
  const auto r = solve_to_accuracy(scene_to_accuracy("patch_flat", "1e-13%"));
  ASSERT_TRUE(r);
  expect_best_of_its_answers(*r);
  const std::vector<AccuracyReport::Solve>& solves = r->accuracy->solves;
  ASSERT_LT(r->accuracy->answer(), int(solves.size()));
  EXPECT_NE(r->accuracy->reason.find("the answer is that of solve " + std::to_string(r->accuracy->answer())),
            std::string::npos);
  EXPECT_LT(solves[0].unknowns, solves[1].unknowns);  // as they were made
}

TEST(Accuracy, EndsWhereTheEstimateRisesTwiceFromWhatTellsP) {
  const auto rises = [](const std::vector<double>& estimates, int step = 100) {
    std::vector<AccuracyReport::Solve> solves;
    for (const double e : estimates) solves.push_back({1000 + step * int(solves.size()), e, 0});
    return estimate_rises(solves);
  };
  EXPECT_TRUE(rises({0.5, 0.1, 0.12, 0.2}));
  EXPECT_FALSE(rises({0.1, 0.12, 0.2}));
  EXPECT_FALSE(rises({0.5, 0.1, 0.12, 0.11}));
  EXPECT_FALSE(rises({0.5, 0.1, 0.12, 0.2}, -100));
  EXPECT_FALSE(rises({0.5, 0.4, 0.5, 0.6}));  // p is on one edge or two
}

// A strip of two metals that bends against a stop with an edge of its own.
TEST(Accuracy, OfAStripThatBendsAgainstAnEdgeIsReached) {
  const TemporaryFolder folder;
  folder.write("strip.geo", R"(SetFactory("OpenCASCADE"); Mesh.ElementOrder = 2;
Rectangle(1) = {0, 0, 0, 60, 2}; Rectangle(2) = {0, 2, 0, 60, 1.5}; Rectangle(3) = {50, 3.9, 0, 8, 5.1};
Physical Surface("a") = {1}; Physical Surface("b") = {2}; Physical Surface("stop") = {3};
Physical Curve("a_s") = {4}; Physical Curve("a_t") = {3}; Physical Curve("b_b") = {5}; Physical Curve("b_s") = {8};
Physical Curve("b_t") = {7}; Physical Curve("stop_b") = {9}; Physical Curve("stop_t") = {11}; MeshSize{ : } = 1.2;
)");
  const auto r = solve_to_accuracy(read_scene(folder.write("strip.toml", R"(mesh.file = "strip.geo"
materials.st = { young = 210e3, poisson = 0.3, thermal_expansion = 12e-6 }
materials.al = { young = 70e3, poisson = 0.33, thermal_expansion = 23e-6 }
bodies = { a = "al", b = "st", stop = "st" }
boundary = [ { on = ["a_s", "b_s"], displacement = { x = 0 } }, { on = "a_s", displacement = { y = 0 } },
             { on = "stop_t", displacement = { x = 0, y = 0 } } ]
initial_strain = [ { body = "a", temperature_change = "40 + 20 * y" }, { body = "b", temperature_change = 60 } ]
contact = [ { between = ["a_t", "b_b"], condition = "tied" }, { between = ["b_t", "stop_b"] } ]
accuracy.value = "1%"
)")));
  ASSERT_TRUE(r);
  EXPECT_LE(r->accuracy->solves.size(), 7u);
  EXPECT_TRUE(r->accuracy->reached()) << r->accuracy->reason;
}

// Two arcs that are one line, under an uneven load: meshes aimed at 0.7 of what is asked missed it by less and less, as
// they hardly grew, for eight solves.
TEST(Accuracy, MissedByAHairIsAimedLower) {
  const TemporaryFolder folder;
  folder.write("a.geo", R"(
Point(1) = {-1, 0, 0}; Point(2) = {0, 0.1, 0}; Point(3) = {1, 0, 0}; Point(4) = {1, -1, 0}; Point(5) = {-1, -1, 0};
Point(9) = {0, -4.95, 0}; Circle(1) = {1, 9, 2}; Circle(2) = {2, 9, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Line(5) = {5, 1}; Curve Loop(1) = {1:5}; Plane Surface(1) = {1};
Point(11) = {-1, 0, 0}; Point(12) = {0, 0.1, 0}; Point(13) = {1, 0, 0}; Point(14) = {1, 1, 0}; Point(15) = {-1, 1, 0};
Circle(11) = {11, 9, 12}; Circle(12) = {12, 9, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(2) = {11:15}; Plane Surface(2) = {2}; Compound Curve{1, 2}; Compound Curve{11, 12};
Physical Surface("lo") = {1}; Physical Surface("up") = {2}; Physical Curve("top") = {1, 2};
Physical Curve("foot") = {11, 12}; Physical Curve("base") = {4}; Physical Curve("head") = {14};
)");
  const Results r = *solve_to_accuracy(read_scene(folder.write("a.toml", R"toml(mesh.file = "a.geo"
materials = { a = { young = 100, poisson = 0.3 }, b = { young = 300, poisson = 0.2 } }
bodies = { lo = "a", up = "b" }
boundary = [{ on = "base", displacement = { x = 0, y = 0 } }, { on = "head", pressure = "1 + 0.2 * sin(3 * x)" },
            { on = "head", displacement = { x = 0 } }]
contact = [{ between = ["foot", "top"] }]
accuracy.value = 1e-3
)toml")));
  EXPECT_TRUE(r.accuracy->reached());
  EXPECT_LE(r.accuracy->solves.size(), 7u);
}

// Hot pellets press on their cladding with their rims, where p has no limit, and with their middles; between, p falls
// to zero or nearly so. Temperatures bend within cells as far as these may.
TEST(Accuracy, OfRodsIsReachedHoweverManyPellets) {
  std::mt19937 random(7);
  const auto one_of = [&](const std::vector<std::string>& all) { return all[random() % all.size()]; };
  for (int k = 0; k < 8; ++k) {
    const std::vector<Override> changes{
        {"mesh.parameters.pellets", one_of({"2", "2", "3", "4"})},
        {"accuracy.value", one_of({"2%", "1%", "0.5%"})},
        {"accuracy.first_edges", one_of({"10", "20", "27", "40"})},
        {"initial_strain.0.temperature_change", one_of({"300", "500", "800"}) + " + 700 * (1 - (x / 4)^2)"}};
    const auto r = solve_to_accuracy(read_scene(MORTISE_SOURCE_DIR "/geo/rod.toml", changes));
    std::ostringstream drawn;
    for (const auto& [key, value] : changes) drawn << key << " = " << value << ' ';
    EXPECT_TRUE(r->accuracy->reached()) << drawn.str() << r->accuracy->reason;
  }
}

// A peak of pressure far narrower than any edge, 0.1 to 0.5 from the line: short edges where it stands, not on the
// line.
TEST(Accuracy, OfNarrowLoadsHasShortEdgesWhereTheyStand) {
  const TemporaryFolder folder;
  std::mt19937 random(5);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  int unknowns = 0;
  for (int k = 0; k < 8; ++k) {
    std::ostringstream geo, scene;
    geo << R"(SetFactory("OpenCASCADE"); Rectangle(1) = {0, -0.4, 0, 1, 0.4}; Rectangle(2) = {0, 0, 0, 1, )"
        << between(0.1, 0.5) << R"(}; Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("seat") = {3}; Physical Curve("bottom") = {1}; Physical Curve("foot") = {5}; Physical Curve("top") = {7};
Physical Curve("sides") = {2, 4, 6, 8};)";
    folder.write("blocks.geo", geo.str());
    scene << R"(mesh.file = "blocks.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { lower = "m", upper = "m" }
boundary = [{ on = "bottom", displacement = { y = 0 } }, { on = "sides", displacement = { x = 0 } },
  { on = "top", pressure = "1 + )"
          << between(10, 40) << " * exp(-((x - " << between(0.2, 0.8) << ") / " << between(0.002, 0.01)
          << ")^2)\" }]\ncontact = [{ between = [\"foot\", \"seat\"] }]\naccuracy.value = \""
          << (k % 2 == 0 ? "2%" : "1%") << "\"\n";
    const auto r = solve_to_accuracy(read_scene(folder.write("scene.toml", scene.str())));
    EXPECT_TRUE(r->accuracy->reached()) << scene.str() << geo.str();
    unknowns += free_unknowns(*r);
  }
  EXPECT_LT(unknowns, 9000);  // 11300 where the line's edges are shortened
}

TEST(Accuracy, HasEverySecondInAStage) {
  const Stopwatch watch;
  const auto r = solve_to_accuracy(scene_to_accuracy("hertz", "1%"));
  const double all = watch.elapsed();
  ASSERT_TRUE(r);
  EXPECT_LE(r->seconds.total(), all);
  EXPECT_GE(r->seconds.total(), 0.9 * all);
}

TEST(Accuracy, OfContactThatOpensEverywhereIsReachedOnTheSecondMesh) {
  const auto r = solve_to_accuracy(
      scene_to_accuracy("hertz", "1%", {{"boundary.2", "{ on = [\"head\"], displacement = { y = 1e-4 } }"}}));
  ASSERT_TRUE(r);
  EXPECT_EQ(r->status, Status::solved);
  EXPECT_EQ(r->accuracy->solves.size(), 2u);
  EXPECT_EQ(largest_entry(r->solution.lambda), 0);
}

// Rollers that lie loose in a frame, under a pressure that does not bring it to them: where they lie is no answer.
TEST(Accuracy, OfLooseBodiesThatNothingPressesIsReachedOnTheSecondMesh) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 7; ++i) {
    const int count = 1 + i % 4;
    const double slack = i == 2 ? 0.011 : 0.01 + 0.1 * part(random);
    std::ostringstream geo, contact;
    geo.precision(12);
    geo << "SetFactory(\"OpenCASCADE\"); n = " << count << "; w = 2 * n + " << slack << "; h = 2 + " << slack << R"(;
Point(1) = {-1, -1, 0}; Point(2) = {w + 1, -1, 0}; Point(3) = {w + 1, h + 1, 0}; Point(4) = {-1, h + 1, 0};
Point(5) = {0, 0, 0}; Point(6) = {w, 0, 0}; Point(7) = {w, h, 0}; Point(8) = {0, h, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5:8}; Plane Surface(1) = {1, 2};
Physical Surface("frame") = {1}; Physical Curve("hole") = {5:8}; Physical Curve("outside") = {1:4};
)";
    for (int k = 0; k < count; ++k) {
      const double x = 1 + 2 * k + slack * (k + part(random)) / count, y = 1 + slack * part(random);
      geo << "Disk(" << 10 + k << ") = {" << x << ", " << y << ", 0, 1}; Physical Surface(\"roller_" << k << "\") = {"
          << 10 + k << "};\nPhysical Curve(\"rim_" << k << "\") = Boundary{ Surface{" << 10 + k << "}; };\n";
      contact << "[[contact]]\nbetween = [\"rim_" << k << "\", \"hole\"]\n";
      if (k > 0) contact << "[[contact]]\nbetween = [\"rim_" << k << "\", \"rim_" << k - 1 << "\"]\n";
    }
    const TemporaryFolder folder;
    folder.write("rollers.geo", geo.str());
    const std::filesystem::path scene = folder.write("rollers.toml", R"(mesh.file = "rollers.geo"
materials.steel = { young = 210e3, poisson = 0.3 }
bodies."*" = "steel"
boundary = [{ on = "outside", pressure = 1 }]
accuracy = { value = "2%" }
)" + contact.str());
    const auto r = solve_to_accuracy(read_scene(scene, {}));
    ASSERT_TRUE(r) << i;
    EXPECT_EQ(r->status, Status::solved) << i;
    EXPECT_EQ(r->accuracy->solves.size(), 2u) << i;
    if (i != 2) continue;
    // The frame's long sides just reach the middle one.
    const auto pressed = solve_to_accuracy(read_scene(scene, {{"boundary.0.pressure", "10"}}));
    ASSERT_TRUE(pressed && pressed->accuracy->reached());
    EXPECT_GT(pressed->recovery.contacts[1].p_max, 200);
  }
}

TEST(Accuracy, KeepsTheLastCompleteAnswerWhenInterrupted) {
  int meshes = 0;
  bool stop = false;
  const auto progress = [&](const std::string& stage) {
    meshes += stage.ends_with(": mesh");
    stop = meshes == 2;
  };
  const auto r = solve_to_accuracy(scene_to_accuracy("hertz", "0.1%"), progress, [&] { return stop; });
  ASSERT_TRUE(r);
  EXPECT_EQ(r->accuracy->solves.size(), 1u);
  EXPECT_EQ(r->accuracy->reason, "interrupted");
  EXPECT_GE(r->status, Status::accuracy_not_reached);
  EXPECT_FALSE(solve_to_accuracy(scene_to_accuracy("hertz", "0.1%"), {}, [] { return true; }));
}

TEST(Accuracy, LeavesTheMeshThatItFoundToOthers) {
  const TemporaryFolder folder;
  for (const char* most : {"1000000", "2500"}) {  // as it is, and held to a number of unknowns
    const auto found = solve_to_accuracy(scene_to_accuracy("punch", "1%", {{"accuracy.unknowns_max", most}}));
    write_msh(found->problem.mesh, folder.path("punch.msh"));
    const Results again =
        solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/punch.toml",
                               {{"mesh.file", "\"" + folder.path("punch.msh") + "\""}, {"mesh.parameters", "{}"}}));
    ASSERT_EQ(again.problem.mesh.cells.size(), found->problem.mesh.cells.size()) << most;
    EXPECT_NEAR(again.recovery.contacts[0].p_max, found->recovery.contacts[0].p_max,
                1e-9 * found->recovery.contacts[0].p_max)
        << most;
  }
}

TEST(Accuracy, IsReachedByEverySolverAndSpace) {
  for (const Override& change : {Override{"method.solver", "ddm"}, Override{"method.solver", "mssor"},
                                 Override{"method.multipliers", "quadratic"}, Override{"method.multipliers", "dual"},
                                 Override{"model.plane", "stress"}, Override{"accuracy.recombine", "true"},
                                 Override{"contact.multipliers_on", "upper_contact"}}) {
    const auto r = solve_to_accuracy(scene_to_accuracy("parabola_1", "0.5%", {change}));
    ASSERT_TRUE(r && r->accuracy->reached()) << change.value;
    EXPECT_EQ(r->status, Status::solved) << change.value;
    EXPECT_LE(free_unknowns(*r), 12000) << change.value;
  }
}

TEST(Accuracy, IsRefusedWhereItCannotBeHad) {
  for (const auto& [value, words] : {std::pair{"0", "expected a part above 0 and below 1"},
                                     {"1%%", "expected a part above 0 and below 1"},
                                     {"100%", "expected a part above 0 and below 1"},
                                     {"-1%", "expected a part above 0 and below 1"}})
    EXPECT_NE(message_of([&] { scene_to_accuracy("hertz", value); }).find(words), std::string::npos) << value;
  for (const auto& [change, words] :
       {std::pair{Override{"accuracy.window", "[0, 1]"}, "accuracy.window: goes with of = \"mean\""},
        {Override{"accuracy.pair", "0"}, "accuracy.pair: goes with of = \"mean\" or \"force\""},
        {Override{"accuracy.of", "mean"}, "'window' is missing; expected [from, to]"},
        {Override{"accuracy.at", "[0, 1]"}, "accuracy.at: goes with of = \"displacement\" or \"stress\""},
        {Override{"accuracy.body", "upper"}, "accuracy.body: goes with of = \"displacement\" or \"stress\""},
        {Override{"accuracy.of", "stress"}, "'at' is missing; expected [x, y], a place in a body"},
        {Override{"accuracy.of", "peek"}, "did you mean 'peak'"},
        {Override{"accuracy.recombine", "1"}, "expected true or false"},
        {Override{"accuracy.first_edges", "1"}, "expected a whole number from 2 to 1000"}})
    expect_contains(message_of([&] { scene_to_accuracy("hertz", "1%", {change}); }), words);
  const TemporaryFolder folder;
  folder.write("a.msh", "");
  const std::string text = R"(
mesh.file = "a.msh"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { a = "steel" }
accuracy.value = 0.01
)";
  EXPECT_NE(message_of([&] { read_scene(folder.write("a.toml", text)); }).find("no [[contact]]"), std::string::npos);
  EXPECT_NE(message_of([&] {
              read_scene(folder.write("b.toml", text + "contact = [{ between = [\"x\", \"y\"] }]\n"));
            }).find("a mesh has no geometry to refine"),
            std::string::npos);
}

}  // namespace
}  // namespace mortise::test
