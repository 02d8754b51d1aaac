// gmsh crashes, ends its process and runs for ever on these; load_mesh throws one line.
#include "gmsh/gmsh_process.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <thread>

#include "gmsh/load_mesh.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TemporaryFolder;

const std::string triangle =
    "Point(1)={0,0,0};Point(2)={1,0,0};Point(3)={0,1,0};Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};\n"
    "Curve Loop(1)={1:3};Plane Surface(1)={1};Physical Surface(\"a\")={1};\n";

class GmshProcesses : public testing::Test {
 protected:
  /// That what meshing this .geo throws is "FILE: gmsh ..." of that form.
  void expect_said(const std::string& text, const std::string& form, double seconds = 60) {
    const std::string file = folder_.write("a.geo", text);
    const std::string message = message_of([&] { load_mesh(file, {}, {.seconds = seconds}); });
    EXPECT_TRUE(message.starts_with(file + ": gmsh")) << message;
    EXPECT_TRUE(std::regex_search(message, std::regex(form))) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  TemporaryFolder folder_;
};

TEST_F(GmshProcesses, ManyMistakes) {
  std::string text;
  for (int i = 1; i <= 25; ++i) {
    const std::string n = std::to_string(i);
    text += "Line(" + n + ") = {" + n + ", 99" + n + "}; Curve Loop(" + n + ") = {77" + n + "}; foo = bar" + n + ";\n";
  }
  expect_said(text, "");
}

TEST_F(GmshProcesses, AnElementOrderThatGmshDoesNotKnow) {
  expect_said(triangle + "Mesh.ElementOrder = 99;\nMesh 2;\n", "crashed|gave up");  // it meshes itself
}

TEST_F(GmshProcesses, Exits) {
  folder_.write("exit.inc", "Exit;\n");
  for (const char* text : {"Exit;\n", "Include StrCat(\"exit\", \".inc\");\n"})
    expect_said(text, "ended the program, as the commands Exit and Abort do");
  expect_said("Abort;\n", "ended the program|gave up");  // gmsh 4.8 frees a text twice on its way out
}

TEST_F(GmshProcesses, AnErrorThatAborts) {
  expect_said("General.AbortOnError = 4;\nx = unknown;\n", "ended the program.*Unknown variable 'unknown'");
}

TEST_F(GmshProcesses, ARecursionWithoutEndMeetsTheTimeLimitOrTheStack) {
  expect_said("Macro R\n Call R;\nReturn\nCall R;\n", "took longer|crashed", 1);
}

TEST_F(GmshProcesses, ALoopWithoutEndMeetsTheTimeLimit) {
  expect_said("For i In {1:1e9}\n x = i;\nEndFor\n", "took longer than mesh.time_limit = 0.5 seconds", 0.5);
}

TEST_F(GmshProcesses, WhatAGeoPrintsStaysOffTheTerminal) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::string file =
      folder_.write("a.geo", triangle + "General.Verbosity = 99; General.Terminal = 1; Printf(\"hello\");\n");
  load_mesh(file, {});
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST_F(GmshProcesses, NothingIsMadeInTheHomeFolderWhichAGeoMayAskFor) {
  const TemporaryFolder home;
  const std::string before = std::getenv("HOME") ? std::getenv("HOME") : "";
  setenv("HOME", home.path().c_str(), 1);
  const std::string asks =
      "If (StrCmp(GetEnv(\"HOME\"), \"" + home.path().string() + "\"))\n Error(\"another home\");\nEndIf\n";
  EXPECT_EQ(load_mesh(folder_.write("a.geo", triangle + asks), {}).bodies.size(), 1U);
  setenv("HOME", before.c_str(), 1);
  EXPECT_TRUE(fs::is_empty(home.path()));
}

TEST_F(GmshProcesses, ThreadsMeshBesideEachOther) {
  const std::string file = MORTISE_SOURCE_DIR "/geo/patch_flat.geo";
  std::vector<Points> expected;
  for (int n = 2; n < 6; ++n) expected.push_back(load_mesh(file, {{"n_upper", n}}).nodes);
  std::atomic<int> right = 0;
  std::vector<std::jthread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (int i = 0; i < 10; ++i) right += load_mesh(file, {{"n_upper", 2 + k}}).nodes == expected[std::size_t(k)];
    });
  threads.clear();
  EXPECT_EQ(right, 40);
}

}  // namespace
}  // namespace mortise
