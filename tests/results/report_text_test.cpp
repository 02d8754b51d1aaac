// What the terminal says of few pairs and of many.
#include "results/report_text.hpp"

#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "base/printable.hpp"
#include "support/wall.hpp"

namespace mortise::test {
namespace {

long lines_of(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ReportText, TellsFourPairsOneByOne) {
  const Wall w = wall(2);
  const Results r = solve_scene(w.scene, w.mesh);
  const std::string text = contact_text(report_of(r));
  EXPECT_EQ(lines_of(text), 12);
  for (const ContactPair& pair : r.problem.pairs) EXPECT_TRUE(contains(text, pair.spec.between[0] + " - ")) << text;
}

TEST(ReportText, OfAWallFitsOneScreenAndNamesItsExtremes) {
  const Wall w = wall(7);
  Results r = solve_scene(w.scene, w.mesh);
  estimate(r);
  const std::string text = report_text(report_of(r), "out");
  EXPECT_LE(lines_of(text), 40) << text;
  EXPECT_TRUE(contains(text, "84 pairs, linear multipliers: 84 unilateral, gap closed")) << text;
  EXPECT_TRUE(contains(text, "b0_0, b1_0, b2_0 and 46 more")) << text;
  const auto highest = std::ranges::max_element(r.recovery.contacts, {}, &ContactResults::p_max);
  const ContactSpec& spec = r.problem.pairs[std::size_t(highest - r.recovery.contacts.begin())].spec;
  EXPECT_TRUE(contains(text, "(" + spec.between[0] + " - " + spec.between[1] + ")\n            largest force")) << text;
}

// A force that balances within its own contact has a bar in its own unit, or none: no percent of nothing.
TEST(ReportText, BarsOfForcesArePartsOfThemOnlyWhereTheyAreLess) {
  const Wall w = wall(2);
  Results r = solve_scene(w.scene, w.mesh);
  estimate(r);
  Json report = report_of(r);
  report["contact"][0]["pressure"]["mean"] = 1;
  report["contact"][0]["length"] = 2;
  const auto told = [&](double force, double error) {
    report["contact"][0]["force"] = {0, force};
    report["contact"][0]["force_error"] = {error, 0};
    return contact_text(report);
  };
  EXPECT_TRUE(contains(told(2, 0.03), " within 1.5 %\n"));
  EXPECT_TRUE(contains(told(0.002, 0.03), " within 0.03\n"));
  EXPECT_TRUE(contains(told(1e-12, 0.03), " within 0.03\n"));
  EXPECT_FALSE(contains(told(1e-12, 1e-11), " within "));
  EXPECT_FALSE(contains(told(2, 1e-7), " within "));
}

TEST(Listed, NamesAllOfFewAndTheFirstOfMany) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a", "b"}), "a, b");
  EXPECT_EQ(listed({"a", "b", "c", "d", "e", "f"}), "a, b, c, d, e, f");
  EXPECT_EQ(listed({"a", "b", "c", "d", "e", "f", "g"}), "a, b, c and 4 more");
}

}  // namespace
}  // namespace mortise::test
