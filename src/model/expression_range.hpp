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
  /// expression itself is that steep; of a smooth one wider than its values by the square of the box's width alone, as
  /// the mean value theorem bounds it too (Moore, Kearfott & Cloud 2009, chapter 6).
  Interval operator()(const std::vector<Interval>& variables) const;

  /// An interval that contains all values on a path in the box, on which the variables are `middle` in the middle and
  /// change by `rates` with a parameter, up to `half` away: by the mean value theorem along it.
  Interval along(const std::vector<Interval>& variables, const std::vector<double>& middle,
                 const std::vector<Interval>& rates, double half) const;

 private:
  friend class RangeParser;
  using Apply = Interval (*)(const Interval* arguments, int count);
  // By each argument the slopes that the result may have.
  using Slopes = void (*)(const Interval* arguments, int count, const Interval& result, Interval* slopes);
  struct Step {
    Apply apply = nullptr;  // to so many on the stack; none: a value
    Slopes slopes = nullptr;
    int count = 0;
    int variable = -1;  // none: a constant
    double constant = 0;
  };
  // A value, and its slopes by the variables where they are asked for.
  struct Value {
    Interval range;
    std::vector<Interval> slopes;
  };
  Value value_on(const std::vector<Interval>& variables, bool with_slopes) const;

  std::vector<Step> steps_;
};

}  // namespace mortise
