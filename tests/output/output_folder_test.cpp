#include "output/output_folder.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <random>
#include <set>

#include "../mesh/grid.hpp"
#include "base/errors.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::text_of;
using Names = std::set<std::string>;

Names names_in(const fs::path& folder) {
  Names names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

void put(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

void write_results(const fs::path& target, const std::string& text) {
  OutputFolder folder(target);
  put(folder.path("result.vtu"), text);
  put(folder.path("summary.json"), text);
  folder.commit();
}

TEST(OutputFolder, AppearsOnCommit) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "out" / "deep" / "run1";
  {
    OutputFolder folder(target);
    put(folder.path("summary.json"), "new");
    EXPECT_FALSE(fs::exists(target));
    folder.commit();
  }
  EXPECT_EQ(text_of(target / "summary.json"), "new");
  EXPECT_EQ(names_in(target.parent_path()), Names{"run1"});
}

TEST(OutputFolder, LeavesNoTraceWithoutCommit) {
  const TemporaryFolder scratch;
  write_results(scratch.path() / "run1", "old");
  {
    OutputFolder folder(scratch.path() / "run1");
    put(folder.path("summary.json"), "new");
  }
  EXPECT_EQ(names_in(scratch.path()), Names{"run1"});
  EXPECT_EQ(text_of(scratch.path() / "run1" / "summary.json"), "old");
}

TEST(OutputFolder, ReplacesOurFilesAndKeepsTheUsers) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "run1";
  scratch.write("run1/contact.csv", "old");  // ours, and not written again
  scratch.write("run1/summary.json", "old");
  scratch.write("run1/notes.txt", "mine");
  scratch.write("run1/pictures/a.png", "mine too");
  fs::create_symlink("/nowhere", target / "link");
  write_results(target, "new");
  EXPECT_EQ(names_in(target), (Names{"result.vtu", "summary.json", "notes.txt", "pictures", "link"}));
  EXPECT_EQ(text_of(target / "summary.json"), "new");
  EXPECT_EQ(text_of(target / "notes.txt"), "mine");
  EXPECT_EQ(text_of(target / "pictures" / "a.png"), "mine too");
  EXPECT_EQ(names_in(scratch.path()), Names{"run1"});
}

TEST(OutputFolder, WritesOnlyWhatItWouldReplace) {
  const TemporaryFolder scratch;
  const OutputFolder folder(scratch.path() / "run1");
  for (const char* name : {"result.vtu", "contact.vtu", "contact.csv", "contact_centres.csv", "iteration.csv"})
    EXPECT_EQ(folder.path(name).filename(), name);
  EXPECT_THROW(folder.path("notes.txt"), std::logic_error);
}

TEST(OutputFolder, KeepsThePermissionsOfTheFolder) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "run1";
  fs::create_directory(target);
  fs::permissions(target, fs::perms::owner_all | fs::perms::group_read);
  write_results(target, "new");
  EXPECT_EQ(fs::status(target).permissions(), fs::perms::owner_all | fs::perms::group_read);
}

TEST(OutputFolder, FollowsALinkToTheFolder) {
  const TemporaryFolder scratch;
  fs::create_directory(scratch.path() / "disk");
  fs::create_directory_symlink(scratch.path() / "disk", scratch.path() / "run1");
  write_results(scratch.path() / "run1/", "new");
  EXPECT_TRUE(fs::is_symlink(scratch.path() / "run1"));
  EXPECT_EQ(text_of(scratch.path() / "disk" / "summary.json"), "new");
}

TEST(OutputFolder, RefusesAFileAndTheCurrentFolder) {
  const TemporaryFolder scratch;
  const std::string file = scratch.write("run1", "a file");
  const auto trouble = [](const fs::path& target) {
    return test::message_of<InputError>([&] { const OutputFolder folder(target); });
  };
  EXPECT_EQ(trouble(file), file + ": cannot write results here: it is a file, expected a folder");
  EXPECT_EQ(text_of(file), "a file");
  EXPECT_NE(trouble(file + "/below").find("cannot write results here"), std::string::npos);
  EXPECT_NE(trouble(".").find("holds the current folder"), std::string::npos);
  EXPECT_NE(trouble("/").find("holds the current folder"), std::string::npos);
  EXPECT_NE(trouble("/proc/mortise").find("cannot write results here"), std::string::npos);
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
  const std::string dead = ".run1." + std::to_string(dead_process()) + ".mortise";
  const std::string alive = ".run1." + std::to_string(getppid()) + ".mortise";
  scratch.write(dead + "/result.vtu", "half-writ");
  scratch.write(alive + "/result.vtu", "half-writ");
  scratch.write(".run1.backup/notes.txt", "mine");
  scratch.write(".run1.12.mortise.txt", "mine");
  scratch.write(".run2.99999999.mortise/result.vtu", "of another target");
  write_results(scratch.path() / "run1", "new");
  EXPECT_EQ(names_in(scratch.path()),
            (Names{"run1", alive, ".run1.backup", ".run1.12.mortise.txt", ".run2.99999999.mortise"}));
}

TEST(OutputFolder, BringsBackWhatAKilledExchangeLeft) {
  const TemporaryFolder scratch;
  const std::string dead = ".run1." + std::to_string(dead_process()) + ".mortise";
  scratch.write(dead + "-old/notes.txt", "mine");  // the target itself, put aside, and no new one in its place
  scratch.write(dead + "/result.vtu", "complete");
  write_results(scratch.path() / "run1", "new");
  EXPECT_EQ(names_in(scratch.path()), Names{"run1"});
  EXPECT_EQ(text_of(scratch.path() / "run1" / "notes.txt"), "mine");
  EXPECT_EQ(text_of(scratch.path() / "run1" / "summary.json"), "new");
}

TEST(ExchangeFolders, InOneStepOrInThree) {
  const TemporaryFolder scratch;
  scratch.write("a/name", "a");
  scratch.write("b/name", "b");
  const fs::path a = scratch.path() / "a";
  const fs::path b = scratch.path() / "b";
  exchange_folders(a, b);
  EXPECT_EQ(text_of(a / "name") + text_of(b / "name"), "ba");
  exchange_folders_in_steps(a, b, aside_of(a));
  EXPECT_EQ(text_of(a / "name") + text_of(b / "name"), "ab");
  EXPECT_EQ(names_in(scratch.path()), (Names{"a", "b"}));
  EXPECT_THROW(exchange_folders_in_steps(scratch.path() / "none", b, aside_of(a)), fs::filesystem_error);
  EXPECT_EQ(text_of(b / "name"), "b");  // put back
  EXPECT_THROW(exchange_folders(scratch.path() / "none", b), fs::filesystem_error);
}

/// Writes results over and over, "1 1 1...", "2 2 2...", until it is killed.
[[noreturn]] void write_for_ever(const fs::path& target) {
  for (int generation = 1;; ++generation) {
    std::string text;
    for (int i = 0; i < 5000; ++i) text += std::to_string(generation) + ' ';
    write_results(target, text);
  }
}

TEST(OutputFolder, IsWholeWheneverTheWriterIsKilled) {
  const TemporaryFolder scratch;
  const fs::path target = scratch.path() / "run1";
  write_results(target, "0 ");
  scratch.write("run1/notes.txt", "mine");
  scratch.write("run1/pictures/a.png", "mine too");
  std::mt19937 random(1);
  std::uniform_int_distribution<useconds_t> microseconds(0, 3000);
  for (int round = 0; round < 200; ++round) {
    const pid_t child = fork();
    if (child == 0) write_for_ever(target);
    usleep(microseconds(random));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);

    const std::string result = text_of(target / "result.vtu");
    ASSERT_EQ(result, text_of(target / "summary.json")) << "round " << round;
    const std::string number = result.substr(0, result.find(' ') + 1);
    ASSERT_EQ(result.size(), number == "0 " ? number.size() : 5000 * number.size()) << "round " << round;
  }
  write_results(target, "last");
  EXPECT_EQ(names_in(scratch.path()), Names{"run1"});
  EXPECT_EQ(names_in(target), (Names{"result.vtu", "summary.json", "notes.txt", "pictures"}));
  EXPECT_EQ(text_of(target / "pictures" / "a.png"), "mine too");
}

TEST(OutputFolder, AFolderWithTheNameOfOneOfOurFilesIsRefused) {
  const test::TemporaryFolder folder;
  const std::string mine = folder.write("run/result.vtu/mine.txt", "mine");
  for (const auto& step : std::vector<std::function<void()>>{[&] { check_output_folder(folder.path("run")); },
                                                             [&] { OutputFolder output(folder.path("run")); }}) {
    test::expect_contains(test::message_of(step), folder.path("run/result.vtu") + ": is a folder");
  }
  EXPECT_EQ(test::text_of(mine), "mine");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFolder, MessagesNameTheTarget) {
  const test::TemporaryFolder folder;
  const OutputFolder output(folder.path("run"));
  EXPECT_EQ(output.with_target(output.path("contact.csv").string() + ": cannot be written"),
            folder.path("run/contact.csv") + ": cannot be written");
}

}  // namespace
}  // namespace mortise
