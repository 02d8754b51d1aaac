// All cases of a scene: their table and files.
#include "app/cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/gradient_figures.hpp"
#include "app/solve_scene.hpp"
#include "base/errors.hpp"
#include "results/report.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

namespace fs = std::filesystem;

// gap_close with cases.
Scene with_cases(const std::vector<Override>& overrides) {
  std::vector<Override> all{{"mesh.parameters.n_upper", "6"}, {"mesh.parameters.n_lower", "5"}};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/gap_close.toml", all);
}

const std::string three =
    "[{name = \"half\", scale = 0.5}, {name = \"less\", \"boundary.2.displacement.y\" = -2e-4}, "
    "{name = \"soft\", \"materials.steel.young\" = 1e9}]";

double figure(const RunRow& row, const std::string& name) {
  for (const auto& [key, value] : row.figures)
    if (key == name) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(SolveCases, SayWhatEachSaysAlone) {
  const Scene scene = with_cases({{"case", three}});
  std::vector<std::string> taken;
  const CaseTable table = solve_cases(scene, {}, {}, [&](const LoadCase& load, const Results& results) {
    taken.push_back(load.name);
    Results alone = solve_scene(case_of(scene, load.name));
    estimate(alone);
    EXPECT_LE(largest_entry(alone.solution.lambda - results.solution.lambda),
              1e-12 * largest_entry(alone.solution.lambda))
        << load.name;
    EXPECT_EQ(alone.solution.active, results.solution.active);
    EXPECT_NEAR(alone.estimate->pressure(), results.estimate->pressure(), 1e-8);
  });
  EXPECT_EQ(table.rows.at(0).status, "solved");
  EXPECT_EQ(table.shared, 1);
  EXPECT_EQ(table.keys,
            (std::vector<std::string>{"case", "scale", "boundary.2.displacement.y", "materials.steel.young"}));
  EXPECT_EQ(table.values[1], (std::vector<std::string>{"less", "1", "-2e-04", ""}));
  EXPECT_GT(figure(table.rows.at(0), "contact.0.pressure.max_error"), 0);
  EXPECT_EQ(figure(table.rows.at(0), "contact.0.from"), 0);
  EXPECT_GT(figure(table.rows.at(0), "contact.0.to"), 0);
}

// Of three blocks one upon another, half as wide each.
TEST(SolveCases, PairsKeepTheirColumnsWhereOthersAreTied) {
  const TemporaryFolder folder;
  folder.write("stack.geo",
               "SetFactory(\"OpenCASCADE\"); Mesh.MeshSizeMax = 1;\n"
               "Rectangle(1) = {0, 0, 0, 4, 1}; Rectangle(2) = {0, 1, 0, 2, 1}; Rectangle(3) = {0, 2, 0, 1, 1};\n"
               "Physical Surface(\"a\") = {1}; Physical Surface(\"b\") = {2}; Physical Surface(\"c\") = {3};\n"
               "Physical Curve(\"ground\") = {1}; Physical Curve(\"a_top\") = {3}; Physical Curve(\"b_foot\") = {5};\n"
               "Physical Curve(\"b_top\") = {7}; Physical Curve(\"c_foot\") = {9}; Physical Curve(\"top\") = {11};\n");
  const Scene scene = read_scene(
      folder.write("stack.toml",
                   "mesh.file = \"stack.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\nbodies.\"*\" = \"m\"\n"
                   "boundary = [ { on = \"ground\", displacement = { x = 0, y = 0 } }, "
                   "{ on = \"top\", traction = [0, -10] } ]\n"
                   "contact = [ { between = [\"b_foot\", \"a_top\"] }, { between = [\"c_foot\", \"b_top\"] } ]\n"
                   "expect = [ { figure = \"contact.1.pressure.mean\", value = 10, tolerance = 1e-6 } ]\n"
                   "[[case]]\nname = \"loose\"\n[[case]]\nname = \"glued\"\ncontact.0.condition = \"tied\"\n"
                   "[[case]]\nname = \"drawn\"\ncontact.1.condition = \"tied\"\ncontact.1.overlap = 0.01\n"));
  std::vector<double> gradients;
  const CaseTable table = solve_cases(scene, {}, {}, [&](const LoadCase& load, const Results& r) {
    if (load.name == "drawn") {
      EXPECT_THROW(linearised(r, {"contact.1.pressure.mean", {}}), InputError);
    } else {
      gradients.push_back(linearised(r, {"contact.1.pressure.mean", {}}).value);
    }
  });
  for (const int k : {0, 1}) {
    EXPECT_EQ(table.rows.at(k).status, "solved");
    EXPECT_NEAR(figure(table.rows.at(k), "contact.1.pressure.mean"), 10, 1e-9);
    EXPECT_NEAR(gradients.at(k), 10, 1e-9);
  }
  EXPECT_TRUE(std::isnan(figure(table.rows.at(1), "contact.0.pressure.mean")));
  EXPECT_GT(figure(table.rows.at(2), "contact.0.pressure.mean"), 0);
  EXPECT_NEAR(figure(table.rows.at(2), "tie.1.overlap"), 0.01, 1e-12);
}

TEST(SolveCases, OneWithoutASolutionSaysSo) {
  const Scene scene = with_cases({{"boundary.2", "{on = \"top\", pressure = 1e6}"},
                                  {"case", "[{name = \"pressed\"}, {name = \"pulled\", scale = -1}]"}});
  const CaseTable table = solve_cases(scene, {}, {});
  EXPECT_EQ(table.rows.at(0).status, "solved");
  EXPECT_TRUE(table.rows.at(1).status.starts_with("bad input: ")) << table.rows.at(1).status;
  EXPECT_EQ(table.worst(), Status::check_failed);
  expect_contains(cases_text("title", table, "folder"), "1 of 2 cases are solved; figures in folder/cases.csv");
  // What all say is bad input.
  const Scene none = with_cases({{"mesh.parameters.n_upper", "-1"}, {"case", "[{scale = [1, 2]}]"}});
  expect_contains(message_of([&] { solve_cases(none, {}, {}); }), "(every case)");
}

// Loads from light to heavy, and one without a solution: bars that hold on one mesh.
TEST(SolveCases, HaveOneMeshOfAnAccuracy) {
  const std::string file = std::string(MORTISE_SOURCE_DIR) + "/geo/hertz.toml";
  const Scene scene =
      read_scene(file, {{"accuracy.value", "0.05"},
                        {"case", "[{name = \"l\", scale = [1, 0.2, 0.02]}, {name = \"pulled\", scale = -1}]"}});
  struct Said {
    double estimated, peak;
    bool reached;
  };
  std::map<std::string, Said> said;
  const CaseTable table = solve_cases(scene, {}, {}, [&](const LoadCase& load, const Results& r) {
    said[load.name] = {r.estimate->pressure(), r.recovery.contacts[0].p_max, report_of(r)["accuracy"]["reached"]};
  });
  for (int k = 0; k < 3; ++k) EXPECT_EQ(table.rows.at(k).status, "solved");
  EXPECT_TRUE(table.rows.at(3).status.starts_with("bad input: "));
  EXPECT_EQ(table.shared, 3);
  EXPECT_EQ(figure(table.rows.at(0), "dofs"), figure(table.rows.at(2), "dofs"));
  ASSERT_EQ(said.size(), 3);
  for (const LoadCase& load : scene.cases) {
    if (load.scale < 0) continue;
    const double exact = 581.290e6 * std::sqrt(load.scale);  // Hertz
    EXPECT_NEAR(said[load.name].peak, exact, 0.02 * exact) << load.name;
    EXPECT_LE(said[load.name].estimated, 0.05) << load.name;
    EXPECT_TRUE(said[load.name].reached) << load.name;
  }
}

// The contact of the one in the middle is a hundredth as wide as the others': no longer than an edge of their mesh.
TEST(SolveCases, OfAnAccuracyMayEachWantAMeshOfItsOwn) {
  const std::string file = std::string(MORTISE_SOURCE_DIR) + "/geo/hertz.toml";
  const Scene scene = read_scene(file, {{"accuracy.value", "0.05"}, {"case", "[{scale = [1, 1e-4, 0.9]}]"}});
  std::map<std::string, double> estimated;
  int calls = 0;
  const CaseTable table = solve_cases(scene, {}, {}, [&](const LoadCase& load, const Results& r) {
    estimated[load.name] = r.estimate->pressure();
    ++calls;
  });
  EXPECT_EQ(calls, 6);  // the first mesh was not good enough for the second case
  for (const auto& [name, error] : estimated) EXPECT_LE(error, 0.05) << name;
  EXPECT_EQ(table.worst(), Status::solved);
}

TEST(SolveCases, OfWhichNoneTouchesAreOpenOnOneMesh) {
  const Scene scene = with_cases({{"accuracy.value", "0.05"},
                                  {"case",
                                   "[{name = \"apart\", \"boundary.2.displacement.y\" = -5e-5}, {name = \"near\", "
                                   "\"boundary.2.displacement.y\" = -9e-5}]"}});
  const CaseTable table = solve_cases(scene, {}, {});
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(table.rows.at(k).status, "solved");
    EXPECT_EQ(figure(table.rows.at(k), "contact.0.pressure.max"), 0);
  }
}

TEST(SolveCases, OfSeveralAccuraciesAreRefused) {
  const Scene one = with_cases({{"case", "[{name = \"a\", \"accuracy.value\" = \"1%\"}]"}});
  expect_contains(message_of([&] { solve_cases(one, {}, {}); }), "case 'a': the mesh of an accuracy is found for all");
  const Scene scene = with_cases({{"case", "[{scale = 1}]"}});
  expect_contains(message_of([&] { case_of(scene, "scale_2"); }), "unknown case 'scale_2'; did you mean 'scale_1'?");
}

TEST(WriteCases, AsMuchAsIsAsked) {
  const TemporaryFolder folder;
  const fs::path out = folder.path("out");
  const std::string two = "[{name = \"a\", scale = 0.5}, {name = \"b\"}]", one = "[{name = \"b\"}]";
  write_cases(with_cases({{"case", two}, {"cases.write", "all"}}), {}, {}, out);
  for (const char* name : {"cases.csv", "cases.pvd", "summary.json", "cases/a/result.vtu", "cases/b/contact.csv"})
    EXPECT_TRUE(fs::exists(out / name)) << name;
  std::ifstream list(out / "cases.pvd");
  const std::string text((std::istreambuf_iterator<char>(list)), {});
  expect_contains(text, "<DataSet timestep=\"1\" part=\"0\" file=\"cases/b/result.vtu\"/>");
  write_cases(with_cases({{"case", one}, {"cases.write", "contact"}}), {}, {}, out);
  EXPECT_FALSE(fs::exists(out / "cases/a"));
  EXPECT_FALSE(fs::exists(out / "cases.pvd"));
  EXPECT_TRUE(fs::exists(out / "cases/b/contact.csv"));
  EXPECT_FALSE(fs::exists(out / "cases/b/result.vtu"));
  folder.write("out/cases/b/mine.txt", "");
  write_cases(with_cases({{"case", one}}), {}, {}, out);
  EXPECT_TRUE(fs::exists(out / "cases/b/mine.txt"));
  EXPECT_FALSE(fs::exists(out / "cases/b/contact.csv"));
  EXPECT_TRUE(fs::exists(out / "cases.csv"));
}

// Nor may the results that it had before, with other loads, pass for those of this run.
TEST(WriteCases, OneWithoutASolutionHasNoResults) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& scale) {
    write_cases(with_cases({{"boundary.2", "{on = \"top\", pressure = 1e6}"},
                            {"case", "[{name = \"a\"}, {name = \"b\", scale = " + scale + "}]"},
                            {"cases.write", "contact"}}),
                {}, {}, folder.path("out"));
    EXPECT_TRUE(fs::exists(folder.path("out/cases/a/contact.csv")));
    return fs::exists(folder.path("out/cases/b/contact.csv"));
  };
  EXPECT_TRUE(write("2"));
  EXPECT_FALSE(write("-1"));
}

}  // namespace
}  // namespace mortise::test
