// Typed access to the values of a document. An unexpected value throws InputError with its place.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "model/field.hpp"
#include "scene/document.hpp"
#include "scene/fail.hpp"
#include "scene/scene.hpp"

namespace mortise::scene_file {

/// Throws InputError: expected ..., found the node's value.
[[noreturn]] void fail_expected(const Node& node, const std::string& expected);

/// Throws unless `node` is a table.
void expect_table(const Node& node);

/// Throws unless `node` is a table whose every key is one of `known`; names the nearest.
void expect_keys(const Node& node, const std::vector<std::string>& known);

/// The entry of that name; null if there is none.
const Node* find(const Node& table, const std::string& name);

/// The entry of that name. Throws if there is none, with `expected` ("a number > 0") for the message.
const Node& require(const Node& table, const std::string& name, const std::string& expected);

/// The one entry of `table` whose name is among `names`. Throws if there are none or several.
const Node& exactly_one(const Node& table, const std::vector<std::string>& names);

/// A finite number.
double number(const Node& node);

/// A whole number between these, both included.
int whole(const Node& node, int least, int most);

/// true or false.
bool boolean(const Node& node);

/// Two finite numbers.
Vec2 number_pair(const Node& node);

/// One point [x, y], or a list of them.
std::vector<Vec2> one_or_more_points(const Node& node);

/// Three finite numbers of directions 1, 2, 3, or of pairs of these.
std::array<double, 3> number_triple(const Node& node, const std::string& expected);

/// The names that an expression of the scene may use. After read_fields.
FieldUse expression_use(const Scene& scene, bool on_curve);

/// A finite number, or an expression. Of `use` the key is filled in.
Field field(const Node& node, FieldUse use);

/// Two of them.
VectorField field_pair(const Node& node, const FieldUse& use);

/// A string; one that may be empty.
const std::string& text(const Node& node);

/// A name: a string that is not empty.
const std::string& name(const Node& node);

/// The names of a list, or the single one given without brackets. At least one.
std::vector<const Node*> names(const Node& node);

/// The entries of an array of tables ([[NAME]]); none if the document has no such array.
std::vector<const Node*> entries(const Node& root, const std::string& section);

/// The value of an enum by its word.
template <class Enum>
Enum choice(const Node& node, const std::vector<Enum>& values) {
  std::vector<std::string> words;
  for (const Enum value : values) {
    words.push_back(to_string(value));
    if (text(node) == words.back()) return value;
  }
  fail(node, unknown_name(node.name, node.text, words));
}

}  // namespace mortise::scene_file
