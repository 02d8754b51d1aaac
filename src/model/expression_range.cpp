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
using Slopes = void (*)(Arguments, int, const Interval&, Interval*);

Interval one(double value) { return {value, value}; }
bool is_one(const Interval& a) { return a.low == a.high; }
Interval square(const Interval& a) { return power(a, one(2)); }
Interval root(const Interval& a) { return rising(std::sqrt, a, 0); }

// Of what jumps: none where it has one value.
void of_steps(Arguments, int count, const Interval& result, Interval* slopes) {
  for (int i = 0; i < count; ++i) slopes[i] = is_one(result) ? one(0) : Interval::everything();
}
void of_sum(Arguments, int count, const Interval&, Interval* slopes) { std::fill_n(slopes, count, one(1)); }
void of_mean(Arguments, int count, const Interval&, Interval* slopes) { std::fill_n(slopes, count, one(1.0 / count)); }
void of_minus(Arguments, int, const Interval&, Interval* slope) { *slope = one(-1); }
void of_extreme(Arguments, int count, const Interval&, Interval* slopes) { std::fill_n(slopes, count, Interval{0, 1}); }
void of_power(Arguments a, int, const Interval& result, Interval* slopes) {
  slopes[0] = a[1] * power(a[0], a[1] - one(1));
  slopes[1] = is_one(a[1]) ? one(0) : result * rising(std::log, a[0], 0);
  if (!is_one(a[1]) && a[0].low <= 0) slopes[0] = slopes[1] = Interval::everything();
}
void of_angle(Arguments a, int, const Interval&, Interval* slopes) {
  const Interval squares = square(a[0]) + square(a[1]);
  slopes[0] = a[1] / squares;
  slopes[1] = -a[0] / squares;
  if (a[1].low <= 0 && a[0].contains(0)) slopes[0] = slopes[1] = Interval::everything();  // it jumps by 2 pi
}

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
  Slopes slopes;
  Apply apply;
};

// As muParser ranks them; of two that begin alike the longer one first.
constexpr std::array operators{
    Operator{"||", 1, of_steps,
             [](Arguments a, int) {
               return truth(may_be_true(a[0]) || may_be_true(a[1]), may_be_false(a[0]) && may_be_false(a[1]));
             }},
    Operator{"&&", 2, of_steps,
             [](Arguments a, int) {
               return truth(may_be_true(a[0]) && may_be_true(a[1]), may_be_false(a[0]) || may_be_false(a[1]));
             }},
    Operator{"<=", 4, of_steps, [](Arguments a, int) { return no(less(a[1], a[0])); }},
    Operator{">=", 4, of_steps, [](Arguments a, int) { return no(less(a[0], a[1])); }},
    Operator{"==", 4, of_steps, [](Arguments a, int) { return equal(a[0], a[1]); }},
    Operator{"!=", 4, of_steps, [](Arguments a, int) { return no(equal(a[0], a[1])); }},
    Operator{"<", 4, of_steps, [](Arguments a, int) { return less(a[0], a[1]); }},
    Operator{">", 4, of_steps, [](Arguments a, int) { return less(a[1], a[0]); }},
    Operator{"+", 5, of_sum, [](Arguments a, int) { return a[0] + a[1]; }},
    Operator{"-", 5, [](Arguments, int, const Interval&, Interval* slopes) { slopes[0] = one(1), slopes[1] = one(-1); },
             [](Arguments a, int) { return a[0] - a[1]; }},
    Operator{"*", 6, [](Arguments a, int, const Interval&, Interval* slopes) { slopes[0] = a[1], slopes[1] = a[0]; },
             [](Arguments a, int) { return a[0] * a[1]; }},
    Operator{
        "/", 6,
        [](Arguments a, int, const Interval& q, Interval* slopes) { slopes[0] = one(1) / a[1], slopes[1] = -q / a[1]; },
        [](Arguments a, int) { return a[0] / a[1]; }},
    Operator{"^", 7, of_power, [](Arguments a, int) { return power(a[0], a[1]); }}};
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
void of_either(Arguments a, int, const Interval&, Interval* slopes) {
  const bool first = !may_be_false(a[0]), told = first || !may_be_true(a[0]);
  slopes[0] = told ? one(0) : Interval::everything();
  slopes[1] = one(first ? 1 : 0);
  slopes[2] = one(first ? 0 : 1);
}

struct Function {
  int count;  // of arguments; 0: one or more
  Slopes slopes;
  Apply apply;
};

const std::map<std::string, Function>& functions() {
  using std::numbers::pi;
  static const std::map<std::string, Function> known{
      {"sin",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = cosine(a[0]); },
        [](Arguments a, int) {
          return cosine(a[0] - Interval{pi / 2, pi / 2});
        }}},
      {"cos",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = -cosine(a[0] - one(pi / 2)); },
        [](Arguments a, int) { return cosine(a[0]); }}},
      {"tan",
       {1, [](Arguments, int, const Interval& f, Interval* slope) { *slope = one(1) + square(f); },
        [](Arguments a, int) { return tangent(a[0]); }}},
      {"asin",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1) / root(one(1) - square(a[0])); },
        [](Arguments a, int) { return rising(std::asin, a[0], -1, 1); }}},
      {"acos",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(-1) / root(one(1) - square(a[0])); },
        [](Arguments a, int) {
          return Interval{pi / 2, pi / 2} - rising(std::asin, a[0], -1, 1);
        }}},
      {"atan",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1) / (one(1) + square(a[0])); },
        [](Arguments a, int) { return rising(std::atan, a[0]); }}},
      {"atan2", {2, of_angle, [](Arguments a, int) { return angle(a[0], a[1]); }}},
      {"sinh",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = rising(std::cosh, absolute(a[0])); },
        [](Arguments a, int) { return rising(std::sinh, a[0]); }}},
      {"cosh",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = rising(std::sinh, a[0]); },
        [](Arguments a, int) { return rising(std::cosh, absolute(a[0])); }}},
      {"tanh",
       {1, [](Arguments, int, const Interval& f, Interval* slope) { *slope = one(1) - square(f); },
        [](Arguments a, int) { return rising(std::tanh, a[0]); }}},
      {"asinh",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1) / root(one(1) + square(a[0])); },
        [](Arguments a, int) { return rising(std::asinh, a[0]); }}},
      {"acosh",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1) / root(square(a[0]) - one(1)); },
        [](Arguments a, int) { return rising(std::acosh, a[0], 1); }}},
      {"atanh",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1) / (one(1) - square(a[0])); },
        [](Arguments a, int) { return rising(std::atanh, a[0], -1, 1); }}},
      {"exp",
       {1, [](Arguments, int, const Interval& f, Interval* slope) { *slope = f; },
        [](Arguments a, int) { return rising(std::exp, a[0]); }}},
      {"ln",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1) / a[0]; },
        [](Arguments a, int) { return rising(std::log, a[0], 0); }}},
      {"log2",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1 / std::numbers::ln2) / a[0]; },
        [](Arguments a, int) { return rising(std::log2, a[0], 0); }}},
      {"log10",
       {1, [](Arguments a, int, const Interval&, Interval* slope) { *slope = one(1 / std::numbers::ln10) / a[0]; },
        [](Arguments a, int) { return rising(std::log10, a[0], 0); }}},
      {"sqrt",
       {1, [](Arguments, int, const Interval& f, Interval* slope) { *slope = one(0.5) / f; },
        [](Arguments a, int) { return rising(std::sqrt, a[0], 0); }}},
      {"abs",
       {1,
        [](Arguments a, int, const Interval&, Interval* slope) {
          *slope = Interval{a[0].low >= 0 ? 1.0 : -1.0, a[0].low < 0 && a[0].high <= 0 ? -1.0 : 1.0};
        },
        [](Arguments a, int) { return absolute(a[0]); }}},
      {"sign",
       {1, of_steps,
        [](Arguments a, int) { return rising([](double x) { return double((x > 0) - (x < 0)); }, a[0]); }}},
      {"rint",
       {1, of_steps, [](Arguments a, int) { return rising([](double x) { return std::floor(x + 0.5); }, a[0]); }}},
      {"min", {0, of_extreme, fold<smaller>}},
      {"max", {0, of_extreme, fold<larger>}},
      {"sum", {0, of_sum, sum}},
      {"avg", {0, of_mean, [](Arguments a, int count) {
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
  bool append(Apply apply, Slopes slopes, int count) {
    steps_.push_back({.apply = apply, .slopes = slopes, .count = count});
    return true;
  }

  bool conditional() {
    if (!binary(1)) return false;
    if (!takes("?")) return true;
    return conditional() && takes(":") && conditional() && append(either, of_either, 3);
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
      append(found->apply, found->slopes, 2);
    }
  }

  // A sign ranks below a power and above a product: -x^2 is -(x^2).
  bool unary() {
    if (takes("+")) return binary(power_priority);
    if (!takes("-")) return primary();
    return binary(power_priority) && append([](Arguments a, int) { return -a[0]; }, of_minus, 1);
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
    return takes(")") && (wanted == 0 || wanted == count) &&
           append(function->second.apply, function->second.slopes, count);
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

namespace {

Interval number(const Interval& a) { return std::isnan(a.low) || std::isnan(a.high) ? Interval::everything() : a; }

// 0 times whatever is 0.
Interval times(const Interval& a, const Interval& b) { return a == one(0) || b == one(0) ? one(0) : number(a * b); }

}  // namespace

ExpressionRange::Value ExpressionRange::value_on(const std::vector<Interval>& variables, bool with_slopes) const {
  const std::size_t of = with_slopes ? variables.size() : 0;
  std::vector<Interval> stack, slopes, by;  // of each value, of each by the variables one after another
  stack.reserve(steps_.size());
  for (const Step& step : steps_) {
    const std::size_t first = stack.size() - step.count;
    std::vector<Interval> found(of, one(0));
    Interval result = one(step.constant);
    if (step.apply) {
      result = number(step.apply(stack.data() + first, step.count));
      by.assign(step.count, {});
      if (with_slopes) step.slopes(stack.data() + first, step.count, result, by.data());
      for (int i = 0; i < step.count; ++i)
        for (std::size_t v = 0; v < of; ++v)
          found[v] = number(found[v] + times(number(by[i]), slopes[(first + i) * of + v]));
    } else if (step.variable >= 0) {
      result = variables[step.variable];
      if (with_slopes) found[step.variable] = one(1);
    }
    stack.resize(first);
    stack.push_back(result);
    slopes.resize(first * of);
    slopes.insert(slopes.end(), found.begin(), found.end());
  }
  return {stack.back(), slopes};
}

Interval ExpressionRange::operator()(const std::vector<Interval>& variables) const {
  const Value over = value_on(variables, true);
  std::vector<Interval> middle;
  for (const Interval& v : variables) middle.push_back(one(v.low + (v.high - v.low) / 2));
  Interval mean = value_on(middle, false).range;
  for (std::size_t v = 0; v < variables.size(); ++v)
    mean = number(mean + times(over.slopes[v], variables[v] - middle[v]));
  return {std::max(over.range.low, mean.low), std::min(over.range.high, mean.high)};
}

Interval ExpressionRange::along(const std::vector<Interval>& variables, const std::vector<double>& middle,
                                const std::vector<Interval>& rates, double half) const {
  const Value over = value_on(variables, true);
  std::vector<Interval> at;
  for (const double value : middle) at.push_back(one(value));
  Interval rate = one(0);
  for (std::size_t v = 0; v < rates.size(); ++v) rate = number(rate + times(over.slopes[v], number(rates[v])));
  return number(value_on(at, false).range + times(rate, {-half, half}));
}

}  // namespace mortise
