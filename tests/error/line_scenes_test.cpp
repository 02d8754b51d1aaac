// Two blocks, or a disc on a block: what data, gaps and kinks do to the bars, which vertices contact reaches, and that
// a closed curve may begin anywhere.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "error/contact_reach.hpp"
#include "error/gap_misfit.hpp"
#include "support/messages.hpp"
#include "support/patches.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Blocks 1 x 0.5, the upper one from x = `left` on; in the middle the line turns by about 2 `kink`.
std::string blocks(double left, double kink) {
  return "left = " + std::to_string(left) + "; kink = " + std::to_string(kink / 2) + R"(;
Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.1;
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 0.5, 0}; Point(4) = {0.5, 0.5 + kink, 0}; Point(5) = {0, 0.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1};
Point(11) = {left, 0.5, 0}; Point(12) = {0.5, 0.5 + kink, 0}; Point(13) = {1, 0.5, 0}; Point(14) = {1, 1, 0}; Point(15) = {left, 1, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(2) = {11 : 15}; Plane Surface(2) = {2};
Transfinite Curve{3, 4} = 6; Transfinite Curve{11, 12} = 7;
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("foot") = {11, 12}; Physical Curve("seat") = {3, 4};
Physical Curve("bottom") = {1}; Physical Curve("top") = {14}; Physical Curve("sides") = {5, 2, 13, 15};
)";
}

struct Data {
  std::string pressure = "1e-3", contact = "", more = "";
};

Results solved(const std::string& geo, const Data& data) {
  const TemporaryFolder folder;
  folder.write("a.geo", geo);
  Results r = solve_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.one = { young = 1, poisson = 0.3 }
bodies = { lower = "one", upper = "one" }
boundary = [ { on = "bottom", displacement = { y = 0 } }, { on = "sides", displacement = { x = 0 } }, { on = "top", pressure = ")" +
                                                                data.pressure +
                                                                R"(" } ]
contact = [{ between = ["foot", "seat"], multipliers_on = "foot")" +
                                                                data.contact + " }]\n" + data.more)));
  estimate(r);
  return r;
}

double largest_bar(const Results& r) { return largest_entry(r.estimate->pressures[0].bar); }

// A block 84 times as stiff on a wider one: its corner has nearly all p_h of the last edges, and opens the vertex
// beside it, on finer meshes too. That is no border of contact.
TEST(StiffCorner, ThatOpensTheVertexBesideItIsWherePHasNoLimit) {
  for (const int each : {2, 4}) {
    const auto level = [](double y) { return [=](double) { return y; }; };
    Scene scene;
    scene.materials = {{"soft", {.young = 2500, .poisson = 0.3}}, {"steel", {.young = 210e3, .poisson = 0.3}}};
    scene.bodies = {{"lower", "soft"}, {"upper", "steel"}};
    BoundarySpec floor{.key = "boundary.0", .on = {"lower_south"}},
        axis{.key = "boundary.1", .on = {"lower_west", "upper_west"}}, load{.key = "boundary.2", .on = {"upper_north"}};
    floor.what = Displacement{0, 0};
    axis.what = Displacement{0, {}};
    load.what = Pressure{1};
    scene.boundaries = {floor, axis, load};
    scene.contacts = {{.key = "contact.0", .between = {"upper_south", "lower_north"}, .multipliers_on = "lower_north"}};
    Results r = solve_scene(scene, mesh_of({block("lower", 60 * each, 20 * each, 0, 60, level(0), level(20)),
                                            block("upper", 20 * each, 20 * each, 0, 20, level(20), level(40))},
                                           CellKind::quad4));
    estimate(r);
    const PressureEstimate& e = r.estimate->pressures[0];
    const Eigen::Index corner = e.line.nearest({20, 20});
    EXPECT_EQ((e.line.p.segment(corner - 2, 5).array() != 0).count(), 2) << each;  // the state that is meant
    ASSERT_EQ(e.singular.size(), 1u) << each;
    EXPECT_NEAR(e.singular[0].position.x(), 20, 1e-12);
    EXPECT_TRUE(e.singular[0].is_unbounded());
    EXPECT_TRUE(e.local.borders.empty()) << each;
    EXPECT_LE(r.estimate->pressure(), 0.05) << each;
  }
}

// Mirrored on the rollers, the gap has a kink there: p = -(E* / 4) 2 slope ln r under a cone (Johnson 1985,
// section 5.3).
TEST(GivenGap, ThatRisesFromALineOfSymmetryMakesALogarithm) {
  const Results sloped = solved(blocks(0, 0), {.contact = R"gap(, initial_gap = "1e-5 * sin(6 * x)")gap"}),
                flat =
                    solved(blocks(0, 0), {.contact = R"gap(, initial_gap = "1e-5 * cos(6.283185307179586 * x)")gap"});
  EXPECT_TRUE(flat.estimate->pressures[0].singular.empty());
  const auto& points = sloped.estimate->pressures[0].singular;
  ASSERT_EQ(points.size(), 2u);
  const double modulus = 1 / (2 * (1 - 0.3 * 0.3));
  for (const SingularPoint& point : points) {
    EXPECT_NEAR(point.log_pressure, modulus / 2 * 6e-5 * std::cos(6 * point.position.x()), 1e-9);
    EXPECT_TRUE(point.is_unbounded());
  }
  AccuracySpec spec;
  spec.of = Goal::stress;
  spec.at = points[0].position;
  spec.body = "upper";
  Results r = sloped;
  expect_contains(message_of([&] { estimate(r, spec); }), "where it grows as ln 1/r; expected a place beside it");
}

// Of p = s: the mean over half a window at the end, 0.3 of the windows' distance, is int z (1 - z^2)^3 / int (1 -
// z^2)^3 = (1 / 8) / (16 / 35) of its length.
TEST(PressureWindows, AtTheEndsAreHalfAsWide) {
  const Results r = solved(blocks(0, 0), {});
  const PressureEstimate& e = r.estimate->pressures[0];
  ASSERT_EQ(e.windows.size(), 5u);
  const Coupling& coupling = r.problem.pairs[0].coupling;
  VecX s = VecX::Zero(coupling.B.rows());
  for (Eigen::Index edge = 0; edge + 1 < e.line.s.size(); ++edge)
    for (const int end : {0, 1})
      if (const int row = coupling.row[coupling.on_edge[edge][end]]; row >= 0) s(row) = e.line.s(edge + end);
  const double away = 0.3 / 3 * (1.0 / 8) / (16.0 / 35);
  const std::array<double, 5> means{away, 1.0 / 6, 0.5, 5.0 / 6, 1 - away};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(e.windows[k].weights.dot(s), means[k], 2e-3) << k;  // rules of few points
}

TEST(PressureWindows, AreNotAtEndsThatAreLeftOut) {
  const Results r = solved(blocks(0.2, 0), {});
  const PressureEstimate& e = r.estimate->pressures[0];
  EXPECT_EQ(e.windows.size(), 4u);
  EXPECT_EQ(e.excluded.front() + e.excluded.back(), 1);
}

TEST(DataEstimate, OfASpikeBetweenTheNodesIsInTheBars) {
  const Results spike = solved(blocks(0, 0), {.pressure = "1e-3 * (1 + 20 * exp(-((x - 0.4137) / 0.004)^2))"}),
                even = solved(blocks(0, 0), {.pressure = "1.14e-3"});
  const VecX &far = spike.estimate->pressures[0].far, &without = even.estimate->pressures[0].far;
  EXPECT_GT(far.maxCoeff(), 20 * without.maxCoeff());
  EXPECT_EQ(std::ranges::count_if(spike.warnings, [](const auto& w) { return w.find("boundary.2") != w.npos; }), 1);
}

// An initial strain that the cells miss works on the duals by its energy.
TEST(DataEstimate, OfAnInitialStrainIsInTheBars) {
  const std::string box =
      "initial_strain = [{ body = 'lower', strain = { xx = 0, yy = \"VALUE\", zz = 0, xy = 0 } }]\n";
  const auto with = [&](const std::string& value) {
    std::string text = box;
    return solved(blocks(0, 0), {.more = text.replace(text.find("VALUE"), 5, value)});
  };
  EXPECT_GT(with("1e-3 * (abs(x - 0.43) < 0.02 && abs(y - 0.3) < 0.02 ? 1 : 0)").estimate->pressures[0].far.maxCoeff(),
            20 * with("1e-3").estimate->pressures[0].far.maxCoeff());
}

TEST(GapMisfit, OfAJumpIsItsPlaceAndOfASpikeAStress) {
  const Results jump = solved(blocks(0, 0), {.contact = ", initial_gap = \"x < 0.4 ? 0 : 1e-5\""});
  const GapErrors at = gap_errors(jump.problem.mesh, jump.problem.pairs[0], jump.problem.discretisation.laws);
  ASSERT_EQ(at.jumps.size(), 1u);
  EXPECT_NEAR(at.jumps[0].position.x(), 0.4, 1e-6);
  const Results spike = solved(blocks(0, 0), {.contact = ", initial_gap = \"1e-5 * exp(-((x - 0.458) / 0.01)^2)\""});
  const GapErrors of_spike = gap_errors(spike.problem.mesh, spike.problem.pairs[0], spike.problem.discretisation.laws);
  EXPECT_TRUE(of_spike.jumps.empty());
  Eigen::Index worst = 0;
  of_spike.l2.maxCoeff(&worst);
  EXPECT_EQ(worst, 5);  // of twelve edges that which has the spike's middle
  EXPECT_GT(largest_bar(spike), 10 * largest_bar(solved(blocks(0, 0), {})));
  const VecX& local = spike.estimate->pressures[0].local.data;  // at both ends of each edge
  for (Eigen::Index e = 0; e < of_spike.l2.size(); ++e)
    EXPECT_GE(std::min(local(e), local(e + 1)), of_spike.l2(e)) << e;
}

// A gap that rises by powers of ten within edges beyond contact closes none of them, whatever these make of it.
TEST(GapMisfit, OfEdgesThatStayOpenIsInNoBar) {
  for (const int power : {16, 20, 24}) {
    const std::string gap = "1e-2 * (x / 0.8)^" + std::to_string(power);
    const Results r = solved(blocks(0, 0), {.contact = ", initial_gap = \"" + gap + "\""});
    const PressureEstimate& e = r.estimate->pressures[0];
    const GapErrors off = gap_errors(r.problem.mesh, r.problem.pairs[0], r.problem.discretisation.laws);
    const double largest = e.line.p.maxCoeff();
    int steep = 0;
    for (Eigen::Index i = 1; i + 1 < e.line.p.size(); ++i) {
      if (e.line.p(i - 1) != 0 || e.line.p(i) != 0 || e.line.p(i + 1) != 0) continue;
      EXPECT_LT(e.bar(i), largest) << power << " " << i;
      steep += std::max(off.l2(i - 1), off.l2(i)) > largest * std::sqrt(e.line.h(i));
    }
    EXPECT_GT(steep, 0) << power;
  }
}

TEST(GapMisfit, OfAnEvenGapIsNone) {
  const Results even = solved(blocks(0, 0), {.contact = ", initial_gap = 0"});
  EXPECT_EQ(gap_errors(even.problem.mesh, even.problem.pairs[0], even.problem.discretisation.laws).l2.size(), 0);
}

// The upper block covers the right part of the lower one's top, seat, which runs from x = 1 to 0 in ten edges; it ends
// within the eighth, whose far vertex is the nearest that the lower body has to that corner.
TEST(ContactReach, IsWhereTheSidesFaceEachOtherAndAreClosed) {
  const Results r = solved(blocks(0.25, 0), {});
  const PressureLine& line = r.estimate->pressures[0].line;
  const ContactReach reach =
      contact_reach(r.problem.mesh, r.problem.pairs[0], r.problem.discretisation.laws, line, r.solution.u, {});
  ASSERT_EQ(reach[1].size(), 11u);
  for (int i = 0; i <= 10; ++i) EXPECT_EQ(reach[1][i].any(), i <= 8) << i;
  for (const Reach& at : reach[0]) EXPECT_TRUE(at.any());
}

// By up to a twentieth of an edge, as round-off of a drawing, it faces the other side's end; beyond it has no pressure.
TEST(ContactNodes, AnEndThatSticksOutALittleHasThePressureThere) {
  std::mt19937 random(2);
  for (int k = 0; k < 8; ++k) {
    const double part = std::pow(10, std::uniform_real_distribution<double>(-4, k < 4 ? -1.4 : -1.0)(random));
    const Results r = solved(blocks(-part / 12, 0), {.contact = ", initial_gap = 0"});  // twelve edges
    const ContactNode& end = r.recovery.contacts[0].multiplier.nodes.front();
    EXPECT_LT(r.problem.mesh.nodes(end.node, 0), 0);
    if (part < 0.049)
      EXPECT_NEAR(end.p, 1e-3, 2 * part * 1e-3 + 1e-9) << part;
    else if (part > 0.051)
      EXPECT_EQ(end.p, 0) << part;
  }
  EXPECT_EQ(
      solved(blocks(-0.06 / 12, 0), {.contact = ", initial_gap = 0"}).recovery.contacts[0].multiplier.nodes.front().p,
      0);
}

TEST(ContactReach, IsNotLostAtAPlaceThatWasFoundBefore) {
  const Results r = solved(blocks(0.25, 0), {});
  const PressureLine& line = r.estimate->pressures[0].line;
  const FoundPoint found{.between = {"seat", "foot"}, .position = {0, 0.5}},
      other{.between = {"a", "b"}, .position = {0, 0.5}};
  EXPECT_TRUE(
      contact_reach(r.problem.mesh, r.problem.pairs[0], r.problem.discretisation.laws, line, r.solution.u, {found})[1]
          .back()
          .any());
  EXPECT_FALSE(
      contact_reach(r.problem.mesh, r.problem.pairs[0], r.problem.discretisation.laws, line, r.solution.u, {other})[1]
          .back()
          .any());
}

// Of the lower block's top, from x = 1 to 0, the part up to x = 0.2 faces the upper one.
TEST(ContactReach, IsFoundFromTheSideThatFacesTheOther) {
  const Results r = solved(blocks(0.25, 0), {});
  PressureLine open = r.estimate->pressures[0].line;
  open.p.setZero();
  const FoundPoint found{.between = {"seat", "foot"}, .position = {0.2, 0.5}};
  const Reach last = contact_reach(r.problem.mesh, r.problem.pairs[0], r.problem.discretisation.laws, open,
                                   r.solution.u, {found})[1][8];
  EXPECT_TRUE(last.before);
  EXPECT_FALSE(last.after);
}

// Where the gap is a border's, contact ends before the place; next to the place p_h says nothing, at a tip as far as it
// swings there.
TEST(ContactReach, EndsBeforeAPlaceThatWasFoundWhereVerticesBesideItAreOpen) {
  const Results r = solved(blocks(0.25, 0), {});
  const ContactPair& pair = r.problem.pairs[0];
  VecX apart = r.solution.u;
  for (const Edge& edge : pair.multiplier.edges)
    for (const int node : edge.nodes) apart(2 * node + 1) = 0.01;
  for (const bool swings : {false, true})
    for (int open = 1; open <= 6; ++open) {
      PressureLine line = r.estimate->pressures[0].line;
      const Eigen::Index corner = line.nearest({0.25, 0.5}), step = corner == 0 ? 1 : -1;
      for (int i = 0; i < open; ++i) line.p(corner + i * step) = 0;
      const FoundPoint found{.between = {"foot", "seat"}, .position = {0.25, 0.5}, .swings = swings};
      const ContactReach reach =
          contact_reach(r.problem.mesh, pair, r.problem.discretisation.laws, line, apart, {found});
      EXPECT_EQ(reach[0][corner].any(), open <= (swings ? 4 : 1)) << swings << ", " << open;
    }
}

// p near a kink of 0.02 goes as E* turn slide / 2 pi r: listed; of a turn of 1e-7 nothing is seen.
TEST(SlidingKinks, AreListedWhereWhatTheyDoIsSeen) {
  const auto kinks = [](const Results& r) {
    return std::ranges::count_if(r.estimate->pressures[0].singular,
                                 [](const SingularPoint& point) { return std::abs(point.position.x() - 0.5) < 1e-6; });
  };
  const Data pushed{.more = "[[body_force]]\nbody = 'upper'\nforce = [1e-4, 0]\n"};
  EXPECT_EQ(kinks(solved(blocks(0, 0.01), pushed)), 1);
  EXPECT_EQ(kinks(solved(blocks(0, 2e-6), pushed)), 0);
}

// Where a closed curve begins, at its leftmost node, says nothing of the pressure and its borders: a disc on a block,
// turned with its mesh.
TEST(ClosedCurves, TellTheSameWhereverTheyBegin) {
  const TemporaryFolder folder;
  folder.write("disc.geo", R"(
Mesh.ElementOrder = 2;
Point(1) = {0, 5, 0}; Point(2) = {5, 5, 0}; Point(3) = {0, 10, 0}; Point(4) = {-5, 5, 0}; Point(5) = {0, 0, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {-10, -15, 0}; Point(12) = {10, -15, 0}; Point(13) = {10, 0, 0}; Point(14) = {-10, 0, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
Physical Surface("disc") = {1}; Physical Surface("block") = {2}; Physical Curve("rim") = {1:4};
Physical Curve("ground") = {11}; Physical Curve("top") = {13};
MeshSize{:} = 2; MeshSize{5} = 0.06;)");
  const auto solved = [&](double angle) {
    std::ostringstream scene;
    scene << std::setprecision(17) << "mesh.file = \"disc.geo\"\nmaterials.rubber = { young = 1000, poisson = 0.3 }\n"
          << "bodies = { \"*\" = \"rubber\" }\nboundary = [{ on = \"ground\", displacement = { x = 0, y = 0 } }]\n"
          << "body_force = [{ body = \"disc\", force = [" << 0.3 * std::sin(angle) << ", " << -0.3 * std::cos(angle)
          << "] }]\ncontact = [{ between = [\"rim\", \"top\"], multipliers_on = \"rim\" }]\n";
    const Scene read = read_scene(folder.write("disc.toml", scene.str()), {});
    Mesh mesh = scene_mesh(read);
    const Eigen::Rotation2Dd turn(angle);
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)
      mesh.nodes.row(i) = (turn * Vec2(mesh.nodes.row(i))).transpose();
    for (Boundary& boundary : mesh.boundaries)
      for (EdgeSamples& samples : boundary.samples)
        for (SamplePiece& piece : samples.pieces)
          for (Vec2& place : piece.places) place = turn * place;
    Results r = solve_scene(read, std::move(mesh));
    estimate(r);
    return r;
  };
  const auto by_node = [](const Results& r) {
    std::map<int, std::pair<double, double>> found;
    for (const ContactNode& node : r.recovery.contacts[0].multiplier.nodes)
      if (!std::isnan(node.gap)) found[node.node] = {node.p, node.p_error};
    return found;
  };
  const auto borders = [](const Results& r, double angle) {
    const PressureEstimate& e = r.estimate->pressures[0];
    std::vector<double> places;
    for (const LineError::Border& border : e.local.borders)
      if (border.place) places.push_back((Eigen::Rotation2Dd(-angle) * e.line.at(*border.place)).x());
    std::ranges::sort(places);
    return places;
  };
  const Results first = solved(0);
  const std::vector<double> first_borders = borders(first, 0);
  ASSERT_EQ(first_borders.size(), 2U);
  const auto expected = by_node(first);
  const double largest = largest_entry(first.recovery.contacts[0].pressure);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> near(-0.3, 0.3);
  for (int i = 0; i < 6; ++i) {
    const double angle = -std::numbers::pi / 2 + near(random);  // the contact is to the left
    const Results r = solved(angle);
    const std::vector<double> places = borders(r, angle);
    ASSERT_EQ(places.size(), 2U) << i;
    for (const int b : {0, 1}) EXPECT_NEAR(places[b], first_borders[b], 1e-5) << i;
    EXPECT_NEAR(r.estimate->pressure(), first.estimate->pressure(), 1e-6 * first.estimate->pressure()) << i;
    for (const auto& [node, p] : by_node(r)) {
      EXPECT_NEAR(p.first, expected.at(node).first, 1e-6 * largest) << i;
      EXPECT_NEAR(p.second, expected.at(node).second, 1e-6 * largest) << i;
    }
  }
}

// A stiff punch with edges of radius r on a soft base, whose edges carry the multipliers and are `edge` long.
Results rounded_punch(double r, double edge) {
  const TemporaryFolder folder;
  folder.write("a.geo", "r = " + std::to_string(r) + "; h = " + std::to_string(edge) + R"(; Mesh.ElementOrder = 2;
Point(1) = {-30, -20, 0, h}; Point(2) = {30, -20, 0, h}; Point(3) = {30, 0, 0, h}; Point(4) = {-30, 0, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(5) = {r - 10, 0, 0, h}; Point(6) = {10 - r, 0, 0, h}; Point(7) = {10 - r, r, 0, h}; Point(8) = {10, r, 0, h};
Point(9) = {10, 10, 0, h}; Point(10) = {-10, 10, 0, h}; Point(11) = {-10, r, 0, h}; Point(12) = {r - 10, r, 0, h};
Line(5) = {5, 6}; Circle(6) = {6, 7, 8}; Line(7) = {8, 9}; Line(8) = {9, 10}; Line(9) = {10, 11};
Circle(10) = {11, 12, 5}; Curve Loop(2) = {5:10}; Plane Surface(2) = {2};
Physical Surface("base") = {1}; Physical Surface("punch") = {2}; Physical Curve("ground") = {1};
Physical Curve("top") = {3}; Physical Curve("foot") = {5, 6, 10}; Physical Curve("head") = {8};
)");
  Results results = solve_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials = { soft = { young = 3e3, poisson = 0.3 }, steel = { young = 210e3, poisson = 0.3 } }
bodies = { base = "soft", punch = "steel" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } },
            { on = "head", rigid = { x = 0, force = [0, -600], about = [0, 10] } }]
contact = [{ between = ["foot", "top"], multipliers_on = "top" }]
)")));
  estimate(results);
  return results;
}

// Largest p is 410, 302 and 639 by meshes that show the fillets, where these say 70 to 270; edges that do not face
// fillets shorter than themselves know of none.
TEST(HiddenFillets, AreInTheBars) {
  for (const auto& [r, edge] : {std::pair(0.4, 2.5), std::pair(0.2, 2.5), std::pair(0.1, 0.6)}) {
    const Results results = rounded_punch(r, edge);
    EXPECT_GT(results.estimate->pressure(), 0.45) << r;
    EXPECT_LT(results.estimate->pressure(), 2) << r;
    EXPECT_EQ(results.estimate->pressures[0].local.narrow_at.size(), 2u) << r;
  }
  EXPECT_TRUE(rounded_punch(3, 2.5).estimate->pressures[0].local.narrow_at.empty());
}

// Nothing holds the upper block along the floor: it is held at one node, which by round-off may be a corner of it.
TEST(HeldMotions, AreNoSupports) {
  std::optional<double> first;
  for (const int degrees : {0, 15, 75, 90, 120, 135, 210, 330}) {
    const double angle = degrees * std::numbers::pi / 180;
    const TemporaryFolder folder;
    folder.write("a.geo", "a = Pi / 180 * " + std::to_string(degrees) + R"(;
Point(1) = {-6, -4, 0}; Point(2) = {6, -4, 0}; Point(3) = {6, 0, 0}; Point(4) = {-6, 0, 0};
Point(5) = {-2.15, 0, 0}; Point(6) = {2.35, 0, 0}; Point(7) = {2.35, 1, 0}; Point(8) = {-2.15, 1, 0};
Rotate{{0, 0, 1}, {0, 0, 0}, a}{ Point{1:8}; }
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Curve Loop(2) = {5:8}; Plane Surface(2) = {2};
Transfinite Curve{1, 3} = 27; Transfinite Curve{2, 4} = 6; Transfinite Curve{5, 7} = 11; Transfinite Curve{6, 8} = 5;
Transfinite Surface{1, 2}; Recombine Surface{1, 2};
Physical Surface("low") = {1}; Physical Surface("up") = {2};
Physical Curve("base") = {1}; Physical Curve("top") = {3}; Physical Curve("foot") = {5}; Physical Curve("head") = {7};
)");
    std::ostringstream scene;
    scene << std::setprecision(17) << R"(mesh.file = "a.geo"
materials = { i = { young = 1000, poisson = 0.2 }, k = { young = 170, poisson = 0.2 } }
bodies = { low = "i", up = "k" }
contact = [{ between = ["foot", "top"], multipliers_on = "top" }]
boundary = [{ on = "base", displacement = { x = 0, y = 0 } }, { on = "head", rigid = { rotation = 0, force = [)"
          << 5 * std::sin(angle) << ", " << -5 * std::cos(angle) << "] } }]\n";
    Results r = solve_scene(read_scene(folder.write("a.toml", scene.str())));
    estimate(r);
    const double estimated = r.estimate->pressure();
    if (!first) first = estimated;
    EXPECT_NEAR(estimated, *first, 1e-6 * *first) << degrees;
  }
}

}  // namespace
}  // namespace mortise::test
