// The range of an expression over intervals of its variables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/interval.hpp"

namespace mortise {

/// An expression as a program on a stack, of which it knows the range. It has the grammar of expressions of place
/// (docs/files.md), apart from rarities; muParser, which evaluates them, shows no tree that could be walked.
class ExpressionRange {
 public:
  /// `variables`: names, by which range() takes their intervals. Nothing where it has a name or a form that is not
  /// known here.
  static std::optional<ExpressionRange> of(const std::string& text, const std::vector<std::string>& variables);

  /// An interval that contains all values over the box. It is no wider than a multiple of the box, unless the
  /// expression itself is that steep.
  Interval operator()(const std::vector<Interval>& variables) const;

 private:
  friend class RangeParser;
  using Apply = Interval (*)(const Interval* arguments, int count);
  struct Step {
    Apply apply = nullptr;  // to so many on the stack; none: a value
    int count = 0;
    int variable = -1;  // none: a constant
    double constant = 0;
  };
  std::vector<Step> steps_;
};

}  // namespace mortise
