#include "base/staged_file.hpp"

#include <gtest/gtest.h>

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

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

bool is_ours(const std::string& line) { return line == "ours"; }

std::string refusal(const fs::path& target, const std::vector<fs::path>& inputs = {}) {
  return message_of([&] { check_target(target, inputs, is_ours); });
}

TEST(StagedFile, AppearsWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string target = folder.write("a.csv", "old");
  {
    const StagedFile file(target);
    EXPECT_EQ(file.path().extension(), ".csv");
    write(file.path(), "half");
  }
  EXPECT_EQ(text_of(target), "old");
  StagedFile file(target);
  write(file.path(), "new");
  file.commit();
  EXPECT_EQ(text_of(target), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(StagedFile, ReplacesTheFileThatALinkLeadsTo) {
  const TemporaryFolder folder;
  const std::string target = folder.write("there/a.csv", "old");
  fs::create_symlink(target, folder.path("link.csv"));
  StagedFile file(folder.path("link.csv"));
  write(file.path(), "new");
  file.commit();
  EXPECT_EQ(text_of(target), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path("link.csv")));
}

TEST(StagedFile, LeavesAFileCalledPartAlone) {
  const TemporaryFolder folder;
  const std::string part = folder.write("a.csv.part", "mine");
  StagedFile file(folder.path("a.csv"));
  write(file.path(), "new");
  file.commit();
  EXPECT_EQ(text_of(part), "mine");
}

TEST(StagedFile, SaysWhereItCannotBe) {
  expect_contains(message_of([] { StagedFile file("/nowhere/a.csv"); }),
                  "/nowhere/a.csv: cannot be written: No such file");
  expect_contains(message_of([] { StagedFile file("/proc/a.csv"); }), "/proc/a.csv: cannot be written: ");
}

TEST(CheckTarget, FreeEmptyOrOursIsGood) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_target(folder.path("new.csv"), {}, is_ours));
  EXPECT_NO_THROW(check_target(folder.write("empty.csv", ""), {}, is_ours));
  EXPECT_NO_THROW(check_target(folder.write("a.csv", "ours\n1\n"), {}, is_ours));
}

TEST(CheckTarget, RefusesWhatIsNotOursOrAnInput) {
  const TemporaryFolder folder;
  const std::string ours = folder.write("a.csv", "ours\n");
  fs::create_symlink(ours, folder.path("link.csv"));
  expect_contains(refusal(folder.write("b.csv", "theirs\n")), "mortise did not write");
  expect_contains(refusal(ours, {ours}), "it is the input " + ours);
  expect_contains(refusal(folder.path("link.csv"), {ours}), "it is the input " + ours);
}

TEST(CheckTarget, RefusesFoldersDevicesAndLoops) {
  const TemporaryFolder folder;
  fs::create_symlink("loop.csv", folder.path("loop.csv"));
  expect_contains(refusal(folder.path("")), "folder");
  expect_contains(refusal("/dev/null"), "a device or a pipe");
  expect_contains(refusal(folder.path("loop.csv")), "loop.csv: cannot be written: ");
}

}  // namespace
}  // namespace mortise
