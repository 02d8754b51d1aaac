#include "model/expression_range.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <numbers>

namespace mortise {

namespace {

using Arguments = const Interval*;
using Apply = Interval (*)(Arguments, int);

// Whether a relation holds, as muParser's 0 and 1: always, never, or either.
Interval truth(bool may_hold, bool may_fail) { return {may_fail ? 0.0 : 1.0, may_hold ? 1.0 : 0.0}; }
bool may_be_true(const Interval& a) { return a.low != 0 || a.high != 0; }
bool may_be_false(const Interval& a) { return a.contains(0); }
Interval less(const Interval& a, const Interval& b) { return truth(a.low < b.high, a.high >= b.low); }
Interval no(const Interval& a) { return truth(may_be_false(a), may_be_true(a)); }
Interval equal(const Interval& a, const Interval& b) {
  return truth(a.low <= b.high && b.low <= a.high, !(a == b && a.low == a.high));
}

struct Operator {
  const char* text;
  int priority;
  Apply apply;
};

// As muParser ranks them; of two that begin alike the longer one first.
constexpr std::array operators{
    Operator{"||", 1,
             [](Arguments a, int) {
               return truth(may_be_true(a[0]) || may_be_true(a[1]), may_be_false(a[0]) && may_be_false(a[1]));
             }},
    Operator{"&&", 2,
             [](Arguments a, int) {
               return truth(may_be_true(a[0]) && may_be_true(a[1]), may_be_false(a[0]) || may_be_false(a[1]));
             }},
    Operator{"<=", 4, [](Arguments a, int) { return no(less(a[1], a[0])); }},
    Operator{">=", 4, [](Arguments a, int) { return no(less(a[0], a[1])); }},
    Operator{"==", 4, [](Arguments a, int) { return equal(a[0], a[1]); }},
    Operator{"!=", 4, [](Arguments a, int) { return no(equal(a[0], a[1])); }},
    Operator{"<", 4, [](Arguments a, int) { return less(a[0], a[1]); }},
    Operator{">", 4, [](Arguments a, int) { return less(a[1], a[0]); }},
    Operator{"+", 5, [](Arguments a, int) { return a[0] + a[1]; }},
    Operator{"-", 5, [](Arguments a, int) { return a[0] - a[1]; }},
    Operator{"*", 6, [](Arguments a, int) { return a[0] * a[1]; }},
    Operator{"/", 6, [](Arguments a, int) { return a[0] / a[1]; }},
    Operator{"^", 7, [](Arguments a, int) { return power(a[0], a[1]); }}};
constexpr int power_priority = 7;

template <Interval (*two)(const Interval&, const Interval&)>
Interval fold(Arguments a, int count) {
  Interval result = a[0];
  for (int i = 1; i < count; ++i) result = two(result, a[i]);
  return result;
}
Interval plus(const Interval& a, const Interval& b) { return a + b; }
Interval sum(Arguments a, int count) { return fold<plus>(a, count); }
Interval either(Arguments a, int) {
  if (!may_be_false(a[0])) return a[1];
  return may_be_true(a[0]) ? hull(a[1], a[2]) : a[2];
}

struct Function {
  int count;  // of arguments; 0: one or more
  Apply apply;
};

const std::map<std::string, Function>& functions() {
  using std::numbers::pi;
  static const std::map<std::string, Function> known{
      {"sin",
       {1,
        [](Arguments a, int) {
          return cosine(a[0] - Interval{pi / 2, pi / 2});
        }}},
      {"cos", {1, [](Arguments a, int) { return cosine(a[0]); }}},
      {"tan", {1, [](Arguments a, int) { return tangent(a[0]); }}},
      {"asin", {1, [](Arguments a, int) { return rising(std::asin, a[0], -1, 1); }}},
      {"acos",
       {1,
        [](Arguments a, int) {
          return Interval{pi / 2, pi / 2} - rising(std::asin, a[0], -1, 1);
        }}},
      {"atan", {1, [](Arguments a, int) { return rising(std::atan, a[0]); }}},
      {"atan2", {2, [](Arguments a, int) { return angle(a[0], a[1]); }}},
      {"sinh", {1, [](Arguments a, int) { return rising(std::sinh, a[0]); }}},
      {"cosh", {1, [](Arguments a, int) { return rising(std::cosh, absolute(a[0])); }}},
      {"tanh", {1, [](Arguments a, int) { return rising(std::tanh, a[0]); }}},
      {"asinh", {1, [](Arguments a, int) { return rising(std::asinh, a[0]); }}},
      {"acosh", {1, [](Arguments a, int) { return rising(std::acosh, a[0], 1); }}},
      {"atanh", {1, [](Arguments a, int) { return rising(std::atanh, a[0], -1, 1); }}},
      {"exp", {1, [](Arguments a, int) { return rising(std::exp, a[0]); }}},
      {"ln", {1, [](Arguments a, int) { return rising(std::log, a[0], 0); }}},
      {"log2", {1, [](Arguments a, int) { return rising(std::log2, a[0], 0); }}},
      {"log10", {1, [](Arguments a, int) { return rising(std::log10, a[0], 0); }}},
      {"sqrt", {1, [](Arguments a, int) { return rising(std::sqrt, a[0], 0); }}},
      {"abs", {1, [](Arguments a, int) { return absolute(a[0]); }}},
      {"sign", {1, [](Arguments a, int) { return rising([](double x) { return double((x > 0) - (x < 0)); }, a[0]); }}},
      {"rint", {1, [](Arguments a, int) { return rising([](double x) { return std::floor(x + 0.5); }, a[0]); }}},
      {"min", {0, fold<smaller>}},
      {"max", {0, fold<larger>}},
      {"sum", {0, sum}},
      {"avg", {0, [](Arguments a, int count) {
                 return sum(a, count) / Interval{double(count), double(count)};
               }}}};
  return known;
}

}  // namespace

// Precedence climbing (Richards & Whitby-Strevens 1980).
class RangeParser {
 public:
  RangeParser(const std::string& text, const std::vector<std::string>& variables,
              std::vector<ExpressionRange::Step>& steps)
      : text_(text), variables_(variables), steps_(steps) {}

  bool whole() {
    if (!conditional()) return false;
    return skip() == text_.size();
  }

 private:
  std::size_t skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_;
  }
  bool takes(const std::string& word) {
    if (text_.compare(skip(), word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }
  bool append(Apply apply, int count) {
    steps_.push_back({.apply = apply, .count = count});
    return true;
  }

  bool conditional() {
    if (!binary(1)) return false;
    if (!takes("?")) return true;
    return conditional() && takes(":") && conditional() && append(either, 3);
  }

  bool binary(int least) {
    if (!unary()) return false;
    for (;;) {
      const auto found = std::ranges::find_if(
          operators, [&](const Operator& o) { return text_.compare(skip(), std::string(o.text).size(), o.text) == 0; });
      if (found == operators.end() || found->priority < least) return true;
      takes(found->text);
      const bool right = found->priority == power_priority;  // of equal ones the last one first
      if (!binary(found->priority + (right ? 0 : 1))) return false;
      append(found->apply, 2);
    }
  }

  // A sign ranks below a power and above a product: -x^2 is -(x^2).
  bool unary() {
    if (takes("+")) return binary(power_priority);
    if (!takes("-")) return primary();
    return binary(power_priority) && append([](Arguments a, int) { return -a[0]; }, 1);
  }

  bool primary() {
    if (takes("(")) return conditional() && takes(")");
    std::size_t end = skip();
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '_')) ++end;
    if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) return named(end);
    double value = 0;
    const auto [rest, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) return false;
    at_ = std::size_t(rest - text_.data());
    steps_.push_back({.constant = value});
    return true;
  }

  bool named(std::size_t end) {
    const std::string name = text_.substr(at_, end - at_);
    at_ = end;
    if (takes("(")) return call(name);
    if (name == "pi") {
      steps_.push_back({.constant = std::numbers::pi});
      return true;
    }
    const auto variable = std::ranges::find(variables_, name);
    if (variable == variables_.end()) return false;
    steps_.push_back({.variable = int(variable - variables_.begin())});
    return true;
  }

  bool call(const std::string& name) {
    const auto function = functions().find(name);
    if (function == functions().end()) return false;
    int count = 0;
    do {
      if (!conditional()) return false;
      ++count;
    } while (takes(","));
    const int wanted = function->second.count;
    return takes(")") && (wanted == 0 || wanted == count) && append(function->second.apply, count);
  }

  const std::string& text_;
  const std::vector<std::string>& variables_;
  std::vector<ExpressionRange::Step>& steps_;
  std::size_t at_ = 0;
};

std::optional<ExpressionRange> ExpressionRange::of(const std::string& text, const std::vector<std::string>& variables) {
  ExpressionRange range;
  if (!RangeParser(text, variables, range.steps_).whole()) return {};
  return range;
}

Interval ExpressionRange::operator()(const std::vector<Interval>& variables) const {
  std::vector<Interval> stack;
  stack.reserve(steps_.size());
  for (const Step& step : steps_) {
    if (!step.apply) {
      stack.push_back(step.variable >= 0 ? variables[step.variable] : Interval{step.constant, step.constant});
      continue;
    }
    const std::size_t first = stack.size() - step.count;
    Interval result = step.apply(stack.data() + first, step.count);
    if (std::isnan(result.low) || std::isnan(result.high)) result = Interval::everything();
    stack.resize(first);
    stack.push_back(result);
  }
  return stack.back();
}

}  // namespace mortise
