// Kinds of values that a key of a scene may have: each reads one, says what is wrong with one, and describes itself as
// JSON Schema does.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/fields.hpp"

namespace mortise::scene_file {

using Json = nlohmann::ordered_json;

template <class T>
struct Kind {
  Json schema;
  std::function<T(const Node&)> read;              ///< throws InputError that says what was expected
  std::function<std::string(const T&)> trouble{};  ///< "expected ..., found ..." of a value that no file gave; or empty
};

/// Any finite number; one that is not negative; one above `least`; one between the two, both excluded.
Kind<double> a_number();
Kind<double> from_zero();
Kind<double> above(double least);
Kind<double> between(double least, double most);

/// One from `least` to `most`, both included.
Kind<double> from_to(double least, double most);

/// One between 0 and 1, both excluded, or as text "1%".
Kind<double> a_part();

/// From `least` to `most`, both included.
Kind<int> whole_number(int least, int most);

Kind<bool> true_or_false();

/// Text; text that is not empty; a list of names, or one.
Kind<std::string> a_text();
Kind<std::string> a_name();
Kind<std::vector<std::string>> some_names();

/// [x, y].
Kind<Vec2> a_pair();

/// A number or an expression; [x, y] of such.
Kind<Field> a_field(const FieldUse& use);
Kind<VectorField> two_fields(const FieldUse& use);

/// One of some words of an enum; any of them.
template <class Enum>
Kind<Enum> one_of(const std::vector<Enum>& values) {
  Json words = Json::array();
  for (const Enum value : values) words.push_back(to_string(value));
  return {{{"enum", words}}, [values](const Node& node) { return choice(node, values); }};
}

template <class Enum>
Kind<Enum> any_of() {
  return one_of(all_of(Enum{}));
}

/// A number as a page has it: 2, not 2.0.
Json plain(double number);

/// A value of either kind.
Json either(const Json& one, const Json& other);

/// A list of between `least` and `most` such (0: any number).
Json list_of(const Json& one, int least, int most = 0);

}  // namespace mortise::scene_file
