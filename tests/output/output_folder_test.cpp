#include "output/output_folder.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>
#include <set>

#include "base/errors.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using test::expect_contains;
using test::message_of;
using test::TemporaryFolder;
using test::text_of;
using Names = std::set<std::string>;

const std::string mark = "{ \"dense_kernel\": \"\" } ";

Names names_in(const fs::path& folder) {
  Names names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

void put(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

void write_results(const fs::path& target, const std::string& text) {
  OutputFolder folder(target);
  put(folder.path("result.vtu"), text);
  put(folder.path("summary.json"), mark + text);
  put(folder.path("contact.vtu"), text);
  folder.commit();
}

const Names whole{"result.vtu", "contact.vtu", "summary.json"};

TEST(OutputFolder, HasItsFilesOnCommitAndNoTraceWithoutOne) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "out" / "deep" / "run1";
  write_results(target, "old");
  {
    OutputFolder folder(target);
    put(folder.path("summary.json"), "new");
    put(folder.path("probes.csv"), "new");
    EXPECT_EQ(text_of(target / "summary.json"), mark + "old");
  }
  EXPECT_EQ(names_in(target), whole);
  EXPECT_EQ(text_of(target / "summary.json"), mark + "old");
}

TEST(OutputFolder, ReplacesOurFilesAndKeepsTheUsers) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "run1";
  scratch.write("run1/contact.csv", "old");  // ours, and not written again
  scratch.write("run1/summary.json", mark + "old");
  scratch.write("run1/notes.txt", "mine");
  scratch.write("run1/pictures/a.png", "mine too");
  fs::create_symlink("/nowhere", target / "link");
  write_results(target, "new");
  Names expected = whole;
  expected.insert({"notes.txt", "pictures", "link"});
  EXPECT_EQ(names_in(target), expected);
  EXPECT_EQ(text_of(target / "result.vtu"), "new");
  EXPECT_EQ(text_of(target / "notes.txt") + text_of(target / "pictures" / "a.png"), "minemine too");
}

// Those of an earlier run of ours; what the user has put into a folder of that name stays.
TEST(OutputFolder, OfARunWithoutCasesKeepsNoneOfAnotherRun) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "run1";
  write_results(target / "cases" / "a", "old");
  write_results(target / "cases" / "b", "old");
  scratch.write("run1/cases/b/notes.txt", "mine");
  write_results(target, "not of a run with cases");
  EXPECT_EQ(names_in(target / "cases" / "a"), whole);
  scratch.write("run1/cases.csv", "of one");
  write_results(target, "new");
  EXPECT_EQ(names_in(target / "cases"), Names{"b"});
  EXPECT_EQ(names_in(target / "cases" / "b"), Names{"notes.txt"});
  EXPECT_EQ(text_of(target / "result.vtu"), "new");
}

TEST(OutputFolder, WritesOnlyWhatItWouldReplace) {
  const TemporaryFolder scratch;
  OutputFolder folder(scratch.path() / "run1");
  for (const char* name :
       {"result.vtu", "contact.vtu", "contact.csv", "contact_centres.csv", "iteration.csv", "probes.csv"})
    EXPECT_EQ(folder.path(name).parent_path(), scratch.path() / "run1");
  EXPECT_THROW(folder.path("notes.txt"), std::logic_error);
}

// A shared folder of a group stays one.
TEST(OutputFolder, LeavesOwnerGroupModeAndIdentityOfTheFolder) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "run1";
  fs::create_directory(target);
  ASSERT_EQ(::chmod(target.c_str(), 02770), 0);
  if (::geteuid() == 0) ASSERT_EQ(::chown(target.c_str(), 1, 1), 0);
  ASSERT_EQ(::chmod(target.c_str(), 02770), 0);
  struct stat before {
  }, after{};
  ::stat(target.c_str(), &before);
  write_results(target, "old");
  write_results(target, "new");
  ::stat(target.c_str(), &after);
  EXPECT_EQ(before.st_mode, after.st_mode);
  EXPECT_EQ(before.st_ino, after.st_ino);
  EXPECT_EQ(std::pair(before.st_uid, before.st_gid), std::pair(after.st_uid, after.st_gid));
}

TEST(OutputFolder, MayBeTheCurrentOneOrALink) {
  const TemporaryFolder scratch;
  fs::create_directory(scratch.path() / "disk");
  fs::create_directory_symlink(scratch.path() / "disk", scratch.path() / "run1");
  write_results(scratch.path() / "run1/", "new");
  EXPECT_TRUE(fs::is_symlink(scratch.path() / "run1"));
  const fs::path here = fs::current_path();
  fs::current_path(scratch.path() / "disk");
  write_results(".", "newer");
  fs::current_path(here);
  EXPECT_EQ(text_of(scratch.path() / "disk" / "result.vtu"), "newer");
}

TEST(OutputFolder, RefusesWhatIsNotItsOwnBeforeAnythingMoves) {
  const TemporaryFolder scratch;
  const auto trouble = [](const fs::path& target) {
    const std::string said = message_of([&] { check_output_folder(target); });
    EXPECT_EQ(message_of([&] { const OutputFolder folder(target); }), said);
    return said;
  };
  const std::string file = scratch.write("file", "a file");
  EXPECT_EQ(trouble(file), file + ": cannot write results here: " + file + " is a file, expected a folder");
  EXPECT_EQ(trouble(file + "/below"),
            file + "/below: cannot write results here: " + file + " is a file, expected a folder");
  expect_contains(trouble("/proc/1/mortise"), "cannot write results here");
  for (const char* other : {"contact.csv", "result.vtu", "summary.json"}) {
    const std::string theirs = scratch.write(std::string(other) + ".d/" + other, "{ of another program }");
    EXPECT_EQ(trouble(fs::path(theirs).parent_path()),
              theirs + ": a file of this name is there that mortise did not write; expected -o another folder");
    EXPECT_EQ(text_of(theirs), "{ of another program }");
  }
  const std::string mine = scratch.write("run/result.vtu/mine.txt", "mine");
  expect_contains(trouble(scratch.path("run")), scratch.path("run/result.vtu") + ": is a folder");
}

/// Runs `step` as a user without rights, and returns what it throws.
std::string said_to_nobody(const std::function<void()>& step) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  if (::fork() == 0) {
    const bool changed = ::setgid(65534) == 0 && ::setuid(65534) == 0;
    const std::string said = changed ? message_of(step) : "no setuid";
    ::_exit(::write(ends[1], said.data(), said.size()) == std::ssize(said) ? 0 : 1);
  }
  ::close(ends[1]);
  std::string said(4096, '\0');
  said.resize(std::size_t(std::max<ssize_t>(0, ::read(ends[0], said.data(), said.size()))));
  ::close(ends[0]);
  ::wait(nullptr);
  return said;
}

TEST(OutputFolder, SaysWithoutRightsThatItHasNone) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs root, to be somebody else";
  const TemporaryFolder scratch;
  fs::permissions(scratch.path(), fs::perms::all);
  const fs::path closed = scratch.path() / "closed", sticky = scratch.path() / "sticky";
  for (const fs::path& target : {closed, sticky}) write_results(target, "a colleague's");
  ::chmod(closed.c_str(), 0755);
  ::chmod(sticky.c_str(), 01777);
  EXPECT_EQ(said_to_nobody([&] { check_output_folder(closed); }),
            closed.string() + ": cannot write results here: Permission denied");
  EXPECT_EQ(said_to_nobody([&] { check_output_folder(closed / "new"); }),
            (closed / "new").string() + ": cannot write results here: Permission denied");
  EXPECT_EQ(said_to_nobody([&] { check_output_folder(sticky); }),
            (sticky / "result.vtu").string() + ": is another user's; expected -o another folder");
  for (const fs::path& target : {closed, sticky}) EXPECT_EQ(names_in(target), whole);
}

/// A process number that was in use and is no longer.
pid_t dead_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}

TEST(OutputFolder, TidiesUpAfterTheDeadOnly) {
  const TemporaryFolder scratch;
  const std::string dead = std::to_string(dead_process()),
                    alive = ".result." + std::to_string(getppid()) + ".mortise.vtu";
  scratch.write("run1/.summary." + dead + ".mortise.json", "half-writ");
  scratch.write("run1/.result." + dead + ".mortise.vtu", "half-writ");
  scratch.write("run1/contact.vtu", "of the run that was killed");
  scratch.write("run1/" + alive, "half-writ");
  scratch.write("run1/.result.backup.vtu", "mine");
  write_results(scratch.path() / "run1", "new");
  Names expected = whole;
  expected.insert({alive, ".result.backup.vtu"});
  EXPECT_EQ(names_in(scratch.path() / "run1"), expected);
}

/// Writes results over and over, "1 1 1...", "2 2 2...", until it is killed.
[[noreturn]] void write_for_ever(const fs::path& target) {
  for (int generation = 1;; ++generation) {
    std::string text;
    for (int i = 0; i < 5000; ++i) text += std::to_string(generation) + ' ';
    write_results(target, text);
  }
}

TEST(OutputFolder, IsWholeWhereverItHasASummaryWheneverTheWriterIsKilled) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "run1";
  write_results(target, "0 ");
  scratch.write("run1/notes.txt", "mine");
  std::mt19937 random(1);
  std::uniform_int_distribution<useconds_t> microseconds(0, 3000);
  int with_summary = 0;
  for (int round = 0; round < 200; ++round) {
    const pid_t child = fork();
    if (child == 0) write_for_ever(target);
    usleep(microseconds(random));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    if (!fs::exists(target / "summary.json")) {
      write_results(target, "0 ");
      continue;
    }
    ++with_summary;
    const std::string result = text_of(target / "result.vtu");
    ASSERT_EQ(mark + result, text_of(target / "summary.json")) << "round " << round;
    ASSERT_EQ(result, text_of(target / "contact.vtu")) << "round " << round;
    const std::string number = result.substr(0, result.find(' ') + 1);
    ASSERT_EQ(result.size(), number == "0 " ? number.size() : 5000 * number.size()) << "round " << round;
  }
  EXPECT_GE(with_summary, 1);
  write_results(target, "last");
  Names expected = whole;
  expected.insert("notes.txt");
  EXPECT_EQ(names_in(target), expected);
}

TEST(OutputFolder, MessagesNameTheTarget) {
  const TemporaryFolder folder;
  OutputFolder output(folder.path("run"));
  const std::string hidden = output.path("contact.csv").string();
  EXPECT_EQ(output.with_target(hidden + ": cannot be written"), folder.path("run/contact.csv") + ": cannot be written");
}

}  // namespace
}  // namespace mortise
