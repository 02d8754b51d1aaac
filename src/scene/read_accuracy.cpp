// [accuracy]
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "model/patterns.hpp"
#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

// A part: 0.01, or "1%".
double part(const Node& node) {
  double value = std::nan("");
  if (node.kind == Node::Kind::string) {
    const std::string& text = node.text;
    double percent = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
    if (error == std::errc() && std::string(end, text.data() + text.size()) == "%") value = percent / 100;
  } else {
    value = number(node);
  }
  if (!(value > 0 && value < 1))
    fail(node, "expected a part above 0 and below 1, such as 0.01 or \"1%\", found " + describe(node));
  return value;
}

// What only some goals have.
void read_goal(const Node& node, int contacts, AccuracySpec& accuracy) {
  const Node *pair = find(node, "pair"), *window = find(node, "window"), *at = find(node, "at"),
             *body = find(node, "body");
  const bool one_pair = accuracy.of == Goal::mean || accuracy.of == Goal::force;
  if (pair && !one_pair) fail(*pair, "goes with of = \"mean\" or \"force\"");
  if (pair) accuracy.pair = whole(*pair, 0, contacts - 1);
  if (window && accuracy.of != Goal::mean) fail(*window, "goes with of = \"mean\"");
  const bool place = accuracy.of == Goal::displacement || accuracy.of == Goal::stress;
  for (const Node* key : {at, body})
    if (key && !place) fail(*key, "goes with of = \"displacement\" or \"stress\"");
  if (place) accuracy.at = number_pair(require(node, "at", "[x, y], a place in a body"));
  if (body) accuracy.body = text(*body);
  if (accuracy.of != Goal::mean) return;
  const Node& given = require(node, "window", "[from, to], arc lengths along the contact line");
  accuracy.window = number_pair(given);
  if (!(accuracy.window(0) < accuracy.window(1)))
    fail(given, "expected [from, to] with from < to, arc lengths along the contact line, found " + describe(given));
}

}  // namespace

void read_accuracy(const Node& root, Scene& scene) {
  const Node* node = find(root, "accuracy");
  if (node == nullptr) return;
  expect_keys(*node, {"of", "pair", "window", "at", "body", "value", "exclude", "unknowns_max", "solves_max",
                      "first_edges", "recombine"});
  AccuracySpec accuracy;
  accuracy.of =
      choice(find(*node, "of"),
             {Goal::pressure, Goal::peak, Goal::half_width, Goal::mean, Goal::force, Goal::displacement, Goal::stress},
             accuracy.of);
  accuracy.value = part(require(*node, "value", "a part such as 0.01 or \"1%\""));
  if (const Node* exclude = find(*node, "exclude")) accuracy.exclude = part(*exclude);
  if (const Node* most = find(*node, "unknowns_max")) accuracy.unknowns_max = whole(*most, 100, 1e9);
  if (const Node* most = find(*node, "solves_max")) accuracy.solves_max = whole(*most, 1, 100);
  if (const Node* edges = find(*node, "first_edges")) accuracy.first_edges = whole(*edges, 2, 1e5);
  if (const Node* recombine = find(*node, "recombine")) accuracy.recombine = boolean(*recombine);
  if (scene.contacts.empty())
    fail(*node, "the accuracy of the contact pressure is asked for where there is no [[contact]]");
  const bool found = std::ranges::any_of(
      scene.contacts, [](const ContactSpec& c) { return is_pattern(c.between[0]) || is_pattern(c.between[1]); });
  read_goal(*node, found ? std::numeric_limits<int>::max() : int(scene.contacts.size()), accuracy);
  if (!scene.mesh_file.ends_with(".geo"))
    fail(*node, "a mesh has no geometry to refine; expected mesh.file = a .geo (with a .msh every solve gives bars)");
  if (!scene.copies.empty())
    fail(*node, "a mesh is found for drawn bodies, not for copies (" + scene.copies.front().key +
                    "); expected one or the other (with copies every solve gives bars)");
  scene.accuracy = accuracy;
}

}  // namespace mortise::scene_file
