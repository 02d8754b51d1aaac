#include "output/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "base/errors.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;
using test::text_of;

TEST(Csv, WritesWordsNumbersAndEmptyFields) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.csv";
  write_csv(file, {{"curve", {"top", "the \"lower\", left"}, {}}, {"p", {}, {1.5, std::nan("")}}});
  EXPECT_EQ(text_of(file), "curve,p\ntop,1.5\n\"the \"\"lower\"\", left\",\n");
}

TEST(Csv, NoWordIsAFormula) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.csv";
  write_csv(file, {{"=name", {"=1+1", "+a", "-b", "@c", "\td", "a;=1", "-3", "-1.5e6"}, {}},
                   {"x", {}, {-1, -2, -3, -4, -5, -6, -7, -8}}});
  EXPECT_EQ(
      text_of(file),
      "\"'=name\",x\n\"'=1+1\",-1\n\"'+a\",-2\n\"'-b\",-3\n\"'@c\",-4\n\"'\td\",-5\n\"a;=1\",-6\n-3,-7\n-1.5e6,-8\n");
}

TEST(Csv, NumbersComeBackToTheBit) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.csv";
  const std::vector<double> numbers{1.0 / 3, -2.5e-310, 210e9, -0.0, std::numeric_limits<double>::max(), 1e-12 + 1};
  write_csv(file, {{"x", {}, numbers}});
  std::istringstream lines(text_of(file));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "x");
  for (const double number : numbers) {
    std::getline(lines, line);
    EXPECT_EQ(std::strtod(line.c_str(), nullptr), number);
  }
}

TEST(Csv, ATableWithoutRowsHasItsHeader) {
  const TemporaryFolder folder;
  write_csv(folder.path() / "a.csv", {{"a", {}, {}}, {"b", {}, {}}});
  EXPECT_EQ(text_of(folder.path() / "a.csv"), "a,b\n");
}

TEST(Csv, SaysWhatCannotBeWritten) {
  EXPECT_THROW(write_csv("/nowhere/a.csv", {{"x", {}, {1.0}}}), InputError);
  EXPECT_THROW(write_csv("/dev/full", {{"x", {}, {1.0}}}), InputError);
}

}  // namespace
}  // namespace mortise
