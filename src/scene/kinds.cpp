#include "scene/kinds.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace mortise::scene_file {
namespace {

// JSON has no infinite numbers.
std::string in_words(double number) { return std::isfinite(number) ? plain(number).dump() : std::to_string(number); }

// A number for which `holds`, which `expected` says in words.
Kind<double> number_that(Json schema, const std::string& expected, const std::function<bool(double)>& holds) {
  return {std::move(schema),
          [=](const Node& node) {
            const double value = number(node);
            if (!holds(value)) fail_expected(node, expected);
            return value;
          },
          [=](const double& value) {
            const bool fits = std::isfinite(value) && holds(value);
            return fits ? std::string{} : "expected " + expected + ", found " + in_words(value);
          }};
}

double part_of(const Node& node) {
  if (node.kind != Node::Kind::string) return number(node);
  const char *begin = node.text.data(), *end = begin + node.text.size();
  double percent = 0;
  const auto [rest, error] = std::from_chars(begin, end, percent);
  return error == std::errc() && std::string(rest, end) == "%" ? percent / 100 : std::nan("");
}

}  // namespace

Json plain(double number) {
  const bool whole = number == std::floor(number) && std::abs(number) < 1e15;  // doubles are exact up to 9e15
  return whole ? Json(std::int64_t(number)) : Json(number);
}

Kind<double> a_number() {
  return number_that({{"type", "number"}}, "a finite number", [](double) { return true; });
}

Kind<double> from_zero() {
  return number_that({{"type", "number"}, {"minimum", 0}}, "a number >= 0", [](double value) { return value >= 0; });
}

Kind<double> above(double least) {
  return number_that({{"type", "number"}, {"exclusiveMinimum", plain(least)}}, "a number > " + in_words(least),
                     [least](double value) { return value > least; });
}

Kind<double> between(double least, double most) {
  return number_that({{"type", "number"}, {"exclusiveMinimum", plain(least)}, {"exclusiveMaximum", plain(most)}},
                     "a number between " + in_words(least) + " and " + in_words(most) + " (both excluded)",
                     [=](double value) { return value > least && value < most; });
}

Kind<double> from_to(double least, double most) {
  return number_that({{"type", "number"}, {"minimum", plain(least)}, {"maximum", plain(most)}},
                     "a number from " + in_words(least) + " to " + in_words(most),
                     [=](double value) { return value >= least && value <= most; });
}

Kind<double> a_part() {
  Kind<double> kind = between(0, 1);
  kind.schema = either(kind.schema, {{"type", "string"}, {"pattern", "^[0-9.eE+-]+%$"}});
  kind.read = [](const Node& node) {
    const double value = part_of(node);
    if (!(value > 0 && value < 1)) fail_expected(node, "a part above 0 and below 1, such as 0.01 or \"1%\"");
    return value;
  };
  return kind;
}

Kind<int> whole_number(int least, int most) {
  Json schema{{"type", "integer"}, {"minimum", least}};
  if (most < std::numeric_limits<int>::max()) schema["maximum"] = most;
  return {schema, [=](const Node& node) { return whole(node, least, most); },
          [=](const int& value) {
            return value >= least && value <= most ? std::string{}
                                                   : "expected a whole number from " + std::to_string(least) + " to " +
                                                         std::to_string(most) + ", found " + std::to_string(value);
          }};
}

Kind<bool> true_or_false() { return {{{"type", "boolean"}}, boolean}; }

Kind<std::string> a_text() { return {{{"type", "string"}}, text}; }

Kind<std::string> a_name() { return {{{"type", "string"}, {"minLength", 1}}, name}; }

Kind<std::vector<std::string>> some_names() {
  return {either(a_name().schema, list_of(a_name().schema, 1)), [](const Node& node) {
            std::vector<std::string> list;
            for (const Node* one : names(node)) list.push_back(one->text);
            return list;
          }};
}

Kind<Vec2> a_pair() {
  return {list_of(a_number().schema, 2, 2), number_pair,
          [](const Vec2& pair) { return std::string(pair.allFinite() ? "" : "expected two finite numbers [x, y]"); }};
}

Kind<Field> a_field(const FieldUse& use) {
  return {{{"type", {"number", "string"}}}, [use](const Node& node) { return field(node, use); }};
}

Kind<VectorField> two_fields(const FieldUse& use) {
  return {list_of(a_field({}).schema, 2, 2), [use](const Node& node) { return field_pair(node, use); }};
}

Json either(const Json& one, const Json& other) { return {{"oneOf", {one, other}}}; }

Json list_of(const Json& one, int least, int most) {
  Json list{{"type", "array"}, {"items", one}, {"minItems", least}};
  if (most > 0) list["maxItems"] = most;
  return list;
}

}  // namespace mortise::scene_file
