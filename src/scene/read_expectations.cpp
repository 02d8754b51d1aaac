// [[expect]]
#include "scene/sections.hpp"

namespace mortise::scene_file {

Keys expectation_keys(Expectation& expectation, const FieldUse& use) {
  return {
      key("figure", expectation.figure, a_name(),
          "a number of summary.json by its dotted key, such as `\"contact.0.pressure.max\"` (pairs by their "
          "`number`), or of a row of probes.csv, from 0: `\"probe.0.u_y\"`",
          "this, or `pressure`"),
      {"value", a_number().schema, "what it should be, not 0", "required with `figure`"},
      key("pressure", expectation.value, a_field(use),
          "a number or an expression: what $p$ should be at each node of a pair's multiplier side that faces the "
          "other, "
          "but for those within `accuracy.exclude` of a point where it has no limit",
          "this, or `figure`"),
      key("pair", expectation.pair, whole_number(0, 1000000), "of `pressure`: the pair, from 0, ties left out"),
      required(
          key("tolerance", expectation.tolerance, a_part(),
              "a part of the value (of the largest that `pressure` says) by which it may be off: 0.01 or `\"1%\"`"),
          "a part of the value such as \"1%\""),
      key("source", expectation.source, a_text(), "where the value is from"),
  };
}

void read_expectations(const Node& root, Scene& scene) {
  for (const Node* entry : entries(root, "expect")) {
    Expectation expectation;
    FieldUse use = expression_use(scene, true);
    use.key = locate(*entry) + ".pressure";
    read(*entry, expectation_keys(expectation, use));
    expectation.key = locate(*entry);
    if (exactly_one(*entry, {"figure", "pressure"}).name == "figure") {
      if (const Node* pair = find(*entry, "pair")) fail(*pair, "goes with 'pressure'; a figure names its pair itself");
      const Node& value = require(*entry, "value", "the number that the figure should be");
      expectation.value = a_number().read(value);
      if (expectation.value.constant() == 0)
        fail(value, "no part of 0 is a tolerance; expected a figure that is not 0");
    } else if (const Node* value = find(*entry, "value")) {
      fail(*value, "goes with 'figure'; 'pressure' is a value itself");
    }
    scene.expectations.push_back(expectation);
  }
}

}  // namespace mortise::scene_file
