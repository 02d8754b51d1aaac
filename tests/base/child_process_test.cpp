// Whatever becomes of a child process, this one goes on and says what it was.
#include "base/child_process.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::expect_contains;
using test::message_of;

std::string said(const std::function<std::string()>& work, double seconds = 20) {
  return message_of([&] { run_in_child({.file = "a.geo", .seconds = seconds}, work); });
}

TEST(ChildProcess, ReturnsBytesOfAnySize) {
  for (const std::size_t size : {std::size_t(0), std::size_t(1), std::size_t(65536), std::size_t(30000000)}) {
    const std::string bytes(size, '\7');
    EXPECT_EQ(run_in_child({.file = "a.geo"}, [&] { return bytes; }), bytes);
  }
}

TEST(ChildProcess, WhatItDoesToItselfIsNotDoneHere) {
  int value = 1;
  run_in_child({.file = "a.geo"}, [&] {
    value = 2;
    std::setlocale(LC_ALL, "C.UTF-8");
    std::printf("off the terminal");
    return std::string();
  });
  EXPECT_EQ(value, 1);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

TEST(ChildProcess, ExceptionsComeThrough) {
  const ChildWork child{.file = "a.geo"};
  EXPECT_EQ(message_of([&] { run_in_child(child, []() -> std::string { throw InputError("a.geo: why"); }); }),
            "a.geo: why");
  EXPECT_THROW(run_in_child(child, []() -> std::string { throw std::domain_error("x"); }), std::domain_error);
  EXPECT_THROW(run_in_child(child, []() -> std::string { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_EQ(message_of<std::runtime_error>([&] { run_in_child(child, []() -> std::string { throw 3; }); }),
            "failed without a message");
  EXPECT_EQ(message_of<ForbiddenAct>(
                [&] { run_in_child(child, []() -> std::string { end_child_by_forbidden_act("runs a program"); }); }),
            "runs a program");
}

std::string endless(int depth) {
  volatile char room[1 << 16];
  room[0] = char(depth);
  return endless(depth + 1) + room[0];
}

TEST(ChildProcess, EachEndHasItsWords) {
  EXPECT_EQ(said([]() -> std::string { std::abort(); }), "a.geo: gmsh gave up (abort)");
  EXPECT_EQ(said([]() -> std::string { std::exit(0); }),
            "a.geo: gmsh ended the program, as the commands Exit and Abort do; remove them");
  for (const auto& [number, words] : {std::pair{SIGSEGV, "crashed (segmentation fault, or a recursion without end)"},
                                      std::pair{SIGFPE, "crashed (floating-point exception)"},
                                      std::pair{SIGKILL, "was killed, as a machine without memory left does"},
                                      std::pair{SIGTERM, "was ended by signal 15"}}) {
    const int own = number;
    EXPECT_EQ(said([own]() -> std::string {
                ::signal(own, SIG_DFL);
                ::kill(::getpid(), own);
                return {};
              }),
              std::string("a.geo: gmsh ") + words);
  }
}

#ifndef __SANITIZE_ADDRESS__
// gmsh lifts the limit as far as it may.
TEST(ChildProcess, ARecursionWithoutEndMeetsTheStacksLimitWhateverTheChildDoesToIt) {
  const std::string message = said([] {
    rlimit stack{};
    ::getrlimit(RLIMIT_STACK, &stack);
    stack.rlim_cur = stack.rlim_max;
    ::setrlimit(RLIMIT_STACK, &stack);
    return endless(0);
  });
  expect_contains(message, "gmsh crashed (segmentation fault, or a recursion without end)");
}
#endif

TEST(ChildProcess, ItsLastMessageIsQuotedWithoutColours) {
  EXPECT_EQ(said([]() -> std::string {
              std::fprintf(stderr, "first\n\033[1m\033[31mError   : no such thing\033[0m\n\n");
              std::abort();
            }),
            "a.geo: gmsh gave up (abort); the last message: Error   : no such thing");
}

TEST(ChildProcess, TheTimeLimitEndsItAndAllThatItHasStarted) {
  const test::TemporaryFolder folder;
  const std::string proof = folder.path("proof");
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(said(
                [&] {
                  if (::fork() == 0) {
                    ::sleep(2);
                    std::fclose(std::fopen(proof.c_str(), "w"));
                    ::_exit(0);
                  }
                  ::sleep(60);
                  return std::string();
                },
                0.3),
            "a.geo: gmsh took longer than mesh.time_limit = 0.3 seconds");
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(30));
  ::sleep(3);
  EXPECT_FALSE(std::filesystem::exists(proof));
}

TEST(ChildProcess, ManyThreadsMayHaveOneEach) {
  std::vector<std::jthread> threads;
  std::atomic<int> right = 0;
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([&right, k] {
      for (int i = 0; i < 25; ++i)
        right +=
            run_in_child({.file = "a.geo"}, [&] { return std::to_string(100 * k + i); }) == std::to_string(100 * k + i);
    });
  threads.clear();
  EXPECT_EQ(right, 200);
}

}  // namespace
}  // namespace mortise
