// gmsh crashes, ends the process and runs for ever on these; mortise says so in one line, with exit status 1.
#include "base/library_guard.hpp"

#include <gtest/gtest.h>
#include <sys/time.h>

#include <csignal>

#include "gmsh/load_mesh.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;
using testing::ExitedWithCode;

const std::string triangle =
    "Point(1)={0,0,0};Point(2)={1,0,0};Point(3)={0,1,0};Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};\n"
    "Curve Loop(1)={1:3};Plane Surface(1)={1};Physical Surface(\"a\")={1};\n";

/// The whole of what the process may say, for a message that starts so behind "a.geo: gmsh ".
std::string one_line(const std::string& start) { return "^mortise: error: [^\n]*a.geo: gmsh " + start + "[^\n]*\n$"; }

class Guard : public testing::Test {
 protected:
  Guard() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  std::string geo(const std::string& text) const { return folder_.write("a.geo", text); }
  TemporaryFolder folder_;
};

using GuardDeathTest = Guard;

TEST_F(GuardDeathTest, ManyMistakesCrashGmsh) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends the process itself at gmsh's double free";
#endif
  std::string text;
  for (int i = 1; i <= 25; ++i) {
    const std::string n = std::to_string(i);
    text += "Line(" + n + ") = {" + n + ", 99" + n + "}; Curve Loop(" + n + ") = {77" + n + "}; foo = bar" + n + ";\n";
  }
  const std::string file = geo(text);
  EXPECT_EXIT(load_mesh(file, {}), ExitedWithCode(1), one_line(".*"));
}

TEST_F(GuardDeathTest, AnElementOrderThatGmshDoesNotKnow) {
  const std::string file = geo(triangle + "Mesh.ElementOrder = 99;\nMesh 2;\n");  // it meshes itself
  EXPECT_EXIT(load_mesh(file, {}), ExitedWithCode(1), one_line("(crashed|gave up)"));
}

TEST_F(GuardDeathTest, AnExitThatNoScanFinds) {
  folder_.write("exit.inc", "Exit;\n");
  const std::string file = geo("Include StrCat(\"exit\", \".inc\");\n");
  EXPECT_EXIT(load_mesh(file, {}), ExitedWithCode(1), one_line("ended the program"));
}

TEST_F(GuardDeathTest, AnErrorThatAborts) {
  const std::string file = geo("General.AbortOnError = 4;\nx = unknown;\n");
  EXPECT_EXIT(load_mesh(file, {}), ExitedWithCode(1), one_line("ended the program.*Unknown variable 'unknown'"));
}

TEST_F(GuardDeathTest, ARecursionWithoutEndMeetsTheTimeLimitOrTheStack) {
  const std::string file = geo("Macro R\n Call R;\nReturn\nCall R;\n");
  EXPECT_EXIT(load_mesh(file, {}, {1.0, true}), ExitedWithCode(1), one_line("(took longer|crashed)"));
}

TEST_F(GuardDeathTest, ALoopWithoutEndMeetsTheTimeLimit) {
  const std::string file = geo("For i In {1:1e9}\n x = i;\nEndFor\n");
  EXPECT_EXIT(load_mesh(file, {}, {0.5, true}), ExitedWithCode(1), one_line("took longer than mesh.time_limit = 0.5"));
}

TEST_F(GuardDeathTest, AStackThatIsUsedUp) {
  EXPECT_EXIT(
      {
        const LibraryGuard guard("a.geo", 60);
        volatile char* deep = nullptr;
        for (;;) {
          deep = static_cast<char*>(alloca(1 << 16));
          deep[0] = 1;
        }
      },
      ExitedWithCode(1), one_line("crashed"));
}

TEST_F(Guard, LeavesHandlersTimerAndOutputAsTheyWere) {
  const auto mark = [](int) {};
  struct sigaction mine {};
  mine.sa_handler = mark;
  struct sigaction old {};
  sigaction(SIGFPE, &mine, &old);
  testing::internal::CaptureStdout();
  load_mesh(geo(triangle), {});
  std::printf("still here");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "still here");
  struct sigaction now {};
  sigaction(SIGFPE, &old, &now);
  EXPECT_EQ(now.sa_handler, mine.sa_handler);
  itimerval timer{};
  getitimer(ITIMER_REAL, &timer);
  EXPECT_EQ(timer.it_value.tv_sec, 0);
  EXPECT_EQ(timer.it_value.tv_usec, 0);
}

TEST_F(Guard, WhatAGeoPrintsStaysOffTheTerminal) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  load_mesh(geo(triangle + "General.Verbosity = 99; General.Terminal = 1; Printf(\"hello\");\n"), {});
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST_F(Guard, AbortIsRefusedBeforeGmshSeesIt) {
  const std::string file = geo("Abort;\n");
  EXPECT_EQ(test::message_of([&] { load_mesh(file, {}); }),
            file + ", line 1: the command Abort would end the program; remove it");
}

}  // namespace
}  // namespace mortise
