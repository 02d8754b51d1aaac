// The command line from outside: exit statuses, messages, files.
#include "app/command_line.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int status;
  std::string out, err;
};

Outcome mortise(std::vector<std::string> arguments) {
  std::vector<const char*> argv{"mortise"};
  for (const std::string& a : arguments) argv.push_back(a.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = run_command_line(int(argv.size()), argv.data());
  return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

std::string geo(const std::string& name) { return std::string(MORTISE_SOURCE_DIR) + "/geo/" + name; }

nlohmann::json summary(const std::string& folder) {
  return nlohmann::json::parse(std::ifstream(folder + "/summary.json"));
}

TEST(CommandLine, SolveWritesTheFilesAndSaysSo) {
  const TemporaryFolder folder;
  const std::string out = folder.path("run");
  const Outcome o = mortise({"solve", geo("patch_flat.toml"), "-o", out});
  EXPECT_EQ(o.status, 0) << o.err;
  for (const char* name : {"result.vtu", "contact.vtu", "contact.csv", "contact_centres.csv", "summary.json"})
    EXPECT_TRUE(fs::exists(fs::path(out) / name)) << name;
  EXPECT_NE(o.out.find("solved"), std::string::npos);
  EXPECT_LE(std::count(o.out.begin(), o.out.end(), '\n'), 24) << "one screen";
}

TEST(CommandLine, WithoutAnEstimateThereIsNone) {
  const TemporaryFolder folder;
  const Outcome o = mortise({"solve", geo("patch_flat.toml"), "-o", folder.path("run"), "--no-estimate"});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_TRUE(summary(folder.path("run"))["estimate"].is_null());
  EXPECT_EQ(o.out.find("estimate  "), std::string::npos) << o.out;
  EXPECT_EQ(mortise({"solve", geo("patch_flat.toml"), "--accuracy", "1%", "--no-estimate"}).status, 1);
}

TEST(CommandLine, SummaryHasTheKeysOtherProgramsRead) {
  const TemporaryFolder folder;
  ASSERT_EQ(mortise({"solve", geo("stack.toml"), "-o", folder.path("run")}).status, 0);
  const nlohmann::json s = summary(folder.path("run"));
  for (const char* key : {"title", "scene", "version", "dense_kernel", "status", "energy"})
    EXPECT_TRUE(s.contains(key)) << key;
  for (const char* key :
       {"integration", "normals", "multipliers", "multipliers_on", "solver", "condition", "initial_gap", "dirichlet"})
    EXPECT_TRUE(s["method"].contains(key)) << key;
  for (const char* key : {"nodes", "elements", "dofs", "multipliers"}) EXPECT_GT(s["mesh"][key].get<int>(), 0) << key;
  EXPECT_LT(s["estimate"]["error"].get<double>(), 1e-9);  // uniform stress
  for (const char* key : {"mesh", "assemble", "couple", "factorise", "solve", "recover", "estimate", "write", "total"})
    EXPECT_GE(s["seconds"][key].get<double>(), 0) << key;
  for (const char* key : {"contact", "contact_coarse", "solver"}) EXPECT_TRUE(s["iterations"].contains(key)) << key;
  ASSERT_EQ(s["contact"].size(), 2u);
  EXPECT_NEAR(s["contact"][0]["pressure"]["mean"].get<double>(), 10e6, 1);
  EXPECT_NEAR(std::abs(s["contact"][0]["force"][1].get<double>()), 8e6, 1);  // 10 MPa on 0.8 m
  EXPECT_NEAR(s["contact"][1]["length_in_contact"].get<double>(), 0.8, 1e-12);
  for (const auto& check : s["checks"]) EXPECT_TRUE(check["ok"].get<bool>()) << check["name"];
}

TEST(CommandLine, AnAccuracyIsAskedForAndToldWithWhatIsLeftOut) {
  const TemporaryFolder folder;
  const Outcome o = mortise({"solve", geo("punch.toml"), "--accuracy", "1%", "-o", folder.path("run")});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("(asked 1 %): "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("left out where p has no limit, near (0.2, 0.2), near (0.4, 0.2)\n"), std::string::npos)
      << o.out;
  const auto told = summary(folder.path("run"));
  EXPECT_TRUE(told["accuracy"]["reached"].get<bool>());
  EXPECT_LE(told["estimate"]["pressure"]["error"].get<double>(), 0.01);
  EXPECT_EQ(told["estimate"]["pressure"]["singular"].size(), 2u);

  const Outcome less = mortise({"solve", geo("punch.toml"), "--accuracy", "0.01%", "--set",
                                "accuracy.unknowns_max=1000", "-o", folder.path("run")});
  EXPECT_EQ(less.status, 2) << less.err;
  EXPECT_NE(less.out.find("not reached: unknowns_max; largest part: "), std::string::npos) << less.out;
  EXPECT_EQ(summary(folder.path("run"))["status"], "accuracy_not_reached");

  const Outcome none = mortise(
      {"solve", geo("punch.toml"), "--accuracy", "5%", "--set", "boundary.2.pressure=0", "-o", folder.path("run")});
  EXPECT_NE(none.out.find("accuracy  p is 0, as contact carries nothing (asked 5 %): "), std::string::npos) << none.out;

  const auto mean = [&](const std::string& window) {
    return mortise({"solve", geo("hertz.toml"), "--accuracy", "5%", "--set", "accuracy.of=mean", "--set",
                    "accuracy.window=" + window, "-o", folder.path("run")});
  };
  EXPECT_EQ(mean("[0, 0.005]").status, 0);
  const auto of_mean = summary(folder.path("run"))["accuracy"];
  EXPECT_EQ(of_mean["of"], "mean");
  EXPECT_NEAR(of_mean["value"][0].get<double>(), 556.46e6, 0.05 * 556.46e6);
  const Outcome off = mean("[5, 6]");
  EXPECT_EQ(off.status, 1);
  EXPECT_NE(
      off.err.find("hertz.toml: accuracy.window: expected a window [from, to] with from < to on the contact line"),
      std::string::npos)
      << off.err;
  const Outcome open = mean("[0.3, 0.5]");
  EXPECT_EQ(open.status, 2);
  EXPECT_NE(open.out.find("mean p not known (asked 5 %)"), std::string::npos) << open.out;
}

TEST(CommandLine, ACommandThatIsNoneIsNamed) {
  EXPECT_EQ(
      mortise({"chek", geo("punch.toml")})
          .err.find(
              "mortise: error: command line: unknown subcommand 'chek'; did you mean 'check'? known: solve, check"),
      0u);
  EXPECT_NE(mortise({}).err.find("subcommand is required"), std::string::npos);
}

TEST(CommandLine, ContactCsvHasOneRowANodeOrderedByArcLength) {
  const TemporaryFolder folder;
  ASSERT_EQ(mortise({"solve", geo("patch_flat.toml"), "-o", folder.path("run")}).status, 0);
  std::ifstream file(folder.path("run/contact.csv"));
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "pair,curve,s,x,y,u_n,p,gap,sigma_n,sigma_2,p_error,p_multiplier");
  std::map<std::string, std::vector<double>> s;
  while (std::getline(file, line)) {
    std::stringstream fields(line);
    std::string pair, curve, value;
    std::getline(fields, pair, ',');
    std::getline(fields, curve, ',');
    std::getline(fields, value, ',');
    s[curve].push_back(std::stod(value));
  }
  EXPECT_EQ(s["upper_contact"].size(), 15u);  // 7 quadratic edges
  EXPECT_EQ(s["lower_contact"].size(), 23u);
  for (const auto& [curve, list] : s) {
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end())) << curve;
    EXPECT_NEAR(list.front(), 0, 1e-12);
    EXPECT_NEAR(list.back(), 0.8, 1e-12);
  }
}

TEST(CommandLine, TheStepsOfTheActiveSetAreShownWhereThereAreMore) {
  const TemporaryFolder folder;
  const Outcome o = mortise({"solve", geo("cosine.toml"), "-o", folder.path("run")});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("changing"), std::string::npos) << o.out;
  const nlohmann::json s = summary(folder.path("run"));
  const auto& steps = s["contact_steps"];
  EXPECT_GT(steps.size(), 1u);
  EXPECT_EQ(steps.size(), s["iterations"]["contact"].get<std::size_t>());
  EXPECT_EQ(steps[0]["active"], s["mesh"]["multipliers"]);  // the first closes all
  EXPECT_GT(steps[0]["tension"].get<double>(), 0);
  EXPECT_EQ(steps.back()["changed"], 0);
  EXPECT_LT(steps.back()["active"], s["mesh"]["multipliers"]);
}

TEST(CommandLine, OneSolveIsSaidToBeOne) {
  const TemporaryFolder folder;
  const Outcome o = mortise({"solve", geo("patch_flat.toml"), "-o", folder.path("run")});
  EXPECT_NE(o.out.find("one solve"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("changing"), std::string::npos) << o.out;
  EXPECT_EQ(summary(folder.path("run"))["iterations"]["contact"], 1);
}

TEST(CommandLine, CheckSaysWhatTheSceneModelsAndWritesNothing) {
  const TemporaryFolder folder;
  const auto before = fs::current_path();
  fs::current_path(folder.path(""));
  const Outcome o = mortise({"check", geo("rings.toml")});
  fs::current_path(before);
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("frictionless"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder.path("")));
}

TEST(CommandLine, MeshWritesAMeshThatSolves) {
  const TemporaryFolder folder;
  ASSERT_EQ(mortise({"mesh", geo("patch_inclined.toml"), "-o", folder.path("m.msh")}).status, 0);
  const Outcome o = mortise({"solve", geo("patch_inclined.toml"), "--set",
                             "mesh={file=\"" + folder.path("m.msh") + "\"}", "-o", folder.path("run")});
  EXPECT_EQ(o.status, 0) << o.err;
}

TEST(CommandLine, HelpAndVersionSucceed) {
  EXPECT_EQ(mortise({"--help"}).status, 0);
  const auto help = mortise({"solve", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("--set KEY=VALUE  "), std::string::npos) << help.out;  // one value: no "..." behind it
  const Outcome o = mortise({"--version"});
  EXPECT_EQ(o.status, 0);
  const std::regex told(
      "mortise [0-9]+\\.[0-9]+\\.[0-9]+( \\(commit [0-9a-f]+(-dirty)?\\))?\n"
      "gmsh [0-9.]+, VTK [0-9.]+, Eigen [0-9.]+, CHOLMOD [0-9.]+, METIS [0-9.]+\nOpenBLAS [0-9.]+ \\w+\n");
  EXPECT_TRUE(std::regex_match(o.out, told)) << o.out;
}

// ---- Bad input: one line, exit status 1, the output folder untouched ----

struct BadInput {
  const char* name;
  std::vector<std::string> arguments;  // after "solve SCENE -o FOLDER", unless `command` is set
  std::vector<std::string> expected;   // parts of the message
  const char* scene = "patch_flat.toml";
};

const BadInput bad_input[] = {
    {"NoBodyOfThatName", {"--set", "bodies={uper=\"steel\", lower=\"steel\"}"}, {"uper", "upper", "body"}},
    {"BodyWithoutMaterial", {"--set", "bodies={upper=\"steel\"}"}, {"lower", "material"}},
    {"NoBoundaryOfThatName", {"--set", "boundary.0.on=[\"left\"]"}, {"left", "boundary.0"}},
    {"NoContactCurveOfThatName",
     {"--set", "contact.0.between=[\"upper_contakt\",\"lower_contact\"]"},
     {"upper_contakt", "upper_contact"}},
    {"NothingHoldsTheLowerBody", {"--set", "boundary.1.displacement={x=0}"}, {"nothing holds", "translation"}},
    {"NothingHoldsAnything", {"--set", "boundary=[{on=[\"top\"], pressure=1e6}]"}, {"nothing holds"}},
    {"BoundariesDisagree",
     {"--set", "boundary.1.displacement={x=0.1,y=0}"},
     {"patch_flat.toml: boundary.1 (", "one value a node", "(0, 0)"}},
    {"ContactCurveInTwoPieces", {"--set", "contact.0.between=[\"upper_contact\",\"lower_left\"]"}, {"lower_left"}},
    {"UnknownParameterOfTheGeo",
     {"--set", "mesh.parameters.n_uper=4"},
     {"patch_flat.toml: mesh.parameters: ", "patch_flat.geo", "n_uper", "n_upper"}},
    {"ElementsOfThirdOrder",
     {"--set", "mesh.parameters.order=3"},
     {"patch_flat.geo", "Mesh.ElementOrder = 3", "expected 1"}},
    {"NoSuchMesh", {"--set", "mesh.file=/no/such.geo"}, {"/no/such.geo"}},
    {"OverrideWithoutValue", {"--set", "method.kind"}, {"method.kind"}},
    {"UnknownOption", {"--fast"}, {"--fast"}},
    {"NoEstimateOfAnAccuracy",
     {"--set", "accuracy.value=5%", "--no-estimate"},
     {"--no-estimate: ", "asks for an accuracy"}},
    {"AccuracyOfAMeshParameterThatIsNotThere",
     {"--accuracy", "5%", "--set", "mesh.parameters.n_uper=4"},
     {"patch_flat.toml: mesh.parameters: ", "n_uper"}},
    {"AccuracyOfNothing", {"--accuracy", ""}, {"--accuracy", "1%", "empty"}},
    {"AccuracyOfAWord", {"--accuracy", "good"}, {"accuracy.value", "1%", "'good'"}},
    {"OutputOfNoName", {"-o", ""}, {"--output", "path", "empty"}},
    {"ProbeThatIsNotThere", {"--set", "probe.0.angle=3"}, {"probe: no entry with index 0; there are 0 entries"}},
    {"LoadThatIsNotThere", {"--set", "body_force.0.force=[0,0]"}, {"body_force: no entry with index 0"}},
    {"ThreadsNotANumber", {"--threads", "many"}, {"many"}},
    {"ThreadsZero", {"--threads", "0"}, {"threads"}},
    {"ThreadsThatOpenBlasDoesNotHave", {"--threads", "129"}, {"--threads", "range 1 to 128"}},
    {"TheLoadPullsTheBodyAway", {"--set", "boundary.2.pressure=-1e6"}, {"nothing holds", "'upper'", "(0, 1)"}},
    {"AClosedGapThatIsOpen",
     {"--set", "contact.initial_gap=closed", "--set", "mesh.parameters.gap=0.01"},
     {"0.01 apart", "curve"},
     "gap_close.toml"},
    {"NegativeNumberOfElements",
     {"--set", "mesh.parameters.n_upper=-3"},
     {"patch_flat.geo", "n_upper = -3", "at least 1"}},
    {"DomainDecompositionWithoutAPair",
     {"--set", "contact=[]", "--set", "method.kind=ddm"},
     {"method.kind", "[[contact]]"}},
    {"KeyOfTooManyParts",
     {"--set", "a.b.c.d.e.f.g.h.i.j.a.b.c.d.e.f.g.h.i.j.a.b.c.d.e.f.g.h.i.j.k.l.m.n=1"},
     {"dotted key"}},
    {"CurvesThatDoNotFace",
     {"--set", "contact.0.between=[\"top\",\"bottom\"]", "--set", "contact.0.initial_gap=measured"},
     {"face"}},
};

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, OneLineExitOneFolderUntouched) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"solve", geo(GetParam().scene), "-o", folder.path("run")};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const Outcome o = mortise(arguments);
  EXPECT_EQ(o.status, 1) << o.err;
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  EXPECT_EQ(o.err.find("mortise: error: "), 0u) << o.err;
  for (const std::string& part : GetParam().expected) EXPECT_NE(o.err.find(part), std::string::npos) << o.err;
  EXPECT_FALSE(fs::exists(folder.path("run")));
}

INSTANTIATE_TEST_SUITE_P(Table, BadInputs, testing::ValuesIn(bad_input),
                         [](const auto& row) { return std::string(row.param.name); });

// ---- Files of others ----

void expect_refused(const Outcome& o, const std::string& said) {
  EXPECT_EQ(o.status, 1) << o.err;
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  EXPECT_NE(o.err.find(said), std::string::npos) << o.err;
}

/// A copy of geo/patch_flat.toml with its .geo made plain: one file in one folder.
std::string scene_in(const TemporaryFolder& folder, const std::string& change = "") {
  const std::string geometry = text_of(geo("patch_flat.geo"));
  fs::create_directory(folder.path("common"));
  for (const auto& entry : fs::directory_iterator(geo("common")))
    fs::copy_file(entry.path(), folder.path("common") / entry.path().filename());
  folder.write("patch_flat.geo", change + geometry);
  return folder.write("scene.toml", text_of(geo("patch_flat.toml")));
}

TEST(CommandLineFiles, AMeshNeverReplacesItsOwnInput) {
  const TemporaryFolder folder;
  const std::string scene = scene_in(folder), msh = folder.path("m.msh");
  ASSERT_EQ(mortise({"mesh", scene, "-o", msh}).status, 0);
  const std::string text = text_of(msh);
  expect_refused(mortise({"mesh", scene, "--set", "mesh={file=\"" + msh + "\"}", "-o", msh}), "it is the input");
  EXPECT_EQ(text_of(msh), text);
  EXPECT_EQ(mortise({"mesh", scene, "-o", msh}).status, 0);  // an older mesh may be
}

TEST(CommandLineFiles, ResultsGoNowhereThatIsNoFolderOfTheirOwn) {
  const TemporaryFolder folder;
  fs::create_symlink("loop", folder.path("loop"));
  fs::create_directories(folder.path("run/result.vtu"));
  for (const std::string& out :
       {folder.write("file", "x"), folder.path("loop"), folder.path("run"), std::string("/proc/x")})
    expect_refused(mortise({"solve", geo("patch_flat.toml"), "-o", out}), out);
  EXPECT_TRUE(fs::is_directory(folder.path("run/result.vtu")));
}

TEST(CommandLineFiles, AMeshThatGmshWouldScaleAsItSavesItIsRefused) {
  const TemporaryFolder folder;
  const std::string scene = scene_in(folder, "Mesh.ScalingFactor = 0.001;\n");
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"check", scene}, {"check", folder.path("patch_flat.geo")}, {"solve", scene, "--accuracy", "5%"}})
    expect_refused(
        mortise(command),
        "patch_flat.geo: Mesh.ScalingFactor = 0.001: expected 1: gmsh scales a mesh as it saves it, and here "
        "it is taken as it is drawn; draw it in the units of the calculation, scale what is drawn (Dilate), "
        "or name the .msh that `gmsh -2` saves");
}

TEST(CommandLineFiles, WithoutProgramsAGeoThatRunsOneIsRefused) {
  const TemporaryFolder folder;
  const std::string proof = folder.path("proof");
  const std::string scene = scene_in(folder, "SystemCall \"touch " + proof + "\";\n");
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"solve", scene, "-o", folder.path("run")}, {"check", scene}, {"mesh", scene, "-o", folder.path("m.msh")}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--no-programs", "--set", "mesh.programs=true"});
    expect_refused(mortise(arguments), "patch_flat.geo: it runs a program; --no-programs");
  }
  EXPECT_FALSE(fs::exists(proof));
  EXPECT_EQ(mortise({"check", scene}).status, 0);  // allowed unless it is asked for
  EXPECT_TRUE(fs::exists(proof));
}

TEST(CommandLineFiles, ControlCharactersDoNotReachTheTerminal) {
  const TemporaryFolder folder;
  const std::string title = "title=\"red \\u001B[31m, bell \\u0007,\\nforged line \\u009B\"";
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"solve", geo("patch_flat.toml"), "-o", folder.path("run\x1b[2J"), "--set", title},
           {"check", geo("patch_flat.toml"), "--set", title},
           {"check", folder.path("none\n\x1b.toml")},
           {"solve\x1b"}}) {
    const Outcome o = mortise(command);
    for (const char c : o.out + o.err)
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << o.out << o.err;
    EXPECT_EQ((o.out + o.err).find("\nforged"), std::string::npos) << o.out;
    EXPECT_EQ((o.out + o.err).find("\xc2\x9b"), std::string::npos) << o.out;
  }
}

TEST(BadCommands, MissingOrUnknown) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {}, {"solv"}, {"solve"}, {"solve", "a.toml", "b.toml"}, {"solve", "/no/such.toml"}}) {
    const Outcome o = mortise(arguments);
    EXPECT_EQ(o.status, 1);
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  }
}

}  // namespace
}  // namespace mortise::test
