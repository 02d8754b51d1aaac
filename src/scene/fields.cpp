#include "scene/fields.hpp"

#include <algorithm>
#include <cmath>

namespace mortise::scene_file {
namespace {

std::string quoted_list(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "'" : ", '") + word + "'";
  return list;
}

}  // namespace

void fail_expected(const Node& node, const std::string& expected) {
  fail(node, "expected " + expected + ", found " + describe(node));
}

void expect_table(const Node& node) {
  if (node.kind != Node::Kind::table) fail_expected(node, "a table");
}

void expect_keys(const Node& node, const std::vector<std::string>& known) {
  expect_table(node);
  for (const Node& entry : node.items) {
    if (std::find(known.begin(), known.end(), entry.name) != known.end()) continue;
    fail(entry.place, node.path, unknown_name("key", entry.name, known));
  }
}

const Node* find(const Node& table, const std::string& name) {
  const auto found =
      std::find_if(table.items.begin(), table.items.end(), [&name](const Node& entry) { return entry.name == name; });
  return found == table.items.end() ? nullptr : &*found;
}

const Node& require(const Node& table, const std::string& name, const std::string& expected) {
  const Node* node = find(table, name);
  if (node == nullptr) fail(table, "'" + name + "' is missing; expected " + expected);
  return *node;
}

const Node& exactly_one(const Node& table, const std::vector<std::string>& names) {
  const Node* one = nullptr;
  for (const std::string& name : names) {
    const Node* node = find(table, name);
    if (node == nullptr) continue;
    if (one != nullptr) {
      fail(blame(*one, *node).place, table.path,
           "'" + one->name + "' and '" + node->name + "' exclude each other; expected exactly one of " +
               quoted_list(names));
    }
    one = node;
  }
  if (one == nullptr) fail(table, "expected exactly one of " + quoted_list(names) + ", found none");
  return *one;
}

double number(const Node& node) {
  if (node.kind != Node::Kind::number) fail_expected(node, "a number");
  if (!std::isfinite(node.number)) fail_expected(node, "a finite number");
  return node.number;
}

int whole(const Node& node, int least, int most) {
  const double value = number(node);
  if (value != std::floor(value) || value < least || value > most)
    fail_expected(node, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return int(value);
}

bool boolean(const Node& node) {
  if (node.kind != Node::Kind::boolean) fail_expected(node, "true or false");
  return node.text == "true";
}

Vec2 number_pair(const Node& node) {
  if (node.kind != Node::Kind::list || node.items.size() != 2) fail_expected(node, "a list of two numbers [x, y]");
  return {number(node.items[0]), number(node.items[1])};
}

std::vector<Vec2> one_or_more_points(const Node& node) {
  const bool many = node.kind == Node::Kind::list && !node.items.empty() &&
                    std::ranges::all_of(node.items, [](const Node& i) { return i.kind == Node::Kind::list; });
  if (!many) return {number_pair(node)};
  std::vector<Vec2> points;
  for (const Node& item : node.items) points.push_back(number_pair(item));
  return points;
}

std::array<double, 3> number_triple(const Node& node, const std::string& expected) {
  if (node.kind != Node::Kind::list || node.items.size() != 3) fail_expected(node, expected);
  return {number(node.items[0]), number(node.items[1]), number(node.items[2])};
}

FieldUse expression_use(const Scene& scene, bool on_curve) {
  FieldUse use{.key = {}, .on_curve = on_curve, .constants = scene.constants};
  for (const FieldSpec& spec : scene.fields) use.functions.push_back(spec.function);
  return use;
}

Field field(const Node& node, FieldUse use) {
  if (node.kind == Node::Kind::number) return number(node);
  if (node.kind != Node::Kind::string) fail_expected(node, "a number or an expression");
  use.key = locate(node);
  try {
    return {node.text, use};
  } catch (const ExpressionError& error) {
    Place place = node.place;
    const int at = int(error.position) + 1;
    if (node.column > 0 && place.setting.empty()) place.column = node.column + int(error.position);
    fail(place, node.path, describe(node) + ", character " + std::to_string(at) + ": " + error.what());
  }
}

VectorField field_pair(const Node& node, const FieldUse& use) {
  if (node.kind != Node::Kind::list || node.items.size() != 2)
    fail_expected(node, "a list of two numbers or expressions [x, y]");
  return {field(node.items[0], use), field(node.items[1], use)};
}

const std::string& text(const Node& node) {
  if (node.kind != Node::Kind::string) fail_expected(node, "a string");
  return node.text;
}

const std::string& name(const Node& node) {
  if (node.kind != Node::Kind::string || node.text.empty()) fail_expected(node, "a name");
  return node.text;
}

std::vector<const Node*> names(const Node& node) {
  if (node.kind == Node::Kind::string) {
    name(node);
    return {&node};
  }
  if (node.kind != Node::Kind::list || node.items.empty()) fail_expected(node, "a list of names");
  std::vector<const Node*> list;
  for (const Node& item : node.items) {
    name(item);
    list.push_back(&item);
  }
  return list;
}

std::vector<const Node*> entries(const Node& root, const std::string& section) {
  const Node* node = find(root, section);
  if (node == nullptr) return {};
  if (node->kind != Node::Kind::list) fail_expected(*node, "entries that each start with [[" + section + "]]");
  std::vector<const Node*> list;
  for (const Node& item : node->items) {
    expect_table(item);
    list.push_back(&item);
  }
  return list;
}

}  // namespace mortise::scene_file
