// [[contact]]
#include <algorithm>

#include "base/patterns.hpp"
#include "scene/fail.hpp"
#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

std::array<std::string, 2> read_between(const Node& node, const Node& entry, Once& once) {
  if (node.kind != Node::Kind::list || node.items.size() != 2) {
    fail(node, "expected a list of two names, found " + describe(node));
  }
  const std::vector<const Node*> curves = names(node);
  const std::string &first = curves[0]->text, &second = curves[1]->text;
  if (first == second && !is_pattern(first)) fail(node, "expected two different curves, found '" + first + "' twice");
  const auto [one, other] = std::minmax(first, second);
  once.take("the pair of '" + one + "' and '" + other + "' stands", *curves[0], entry);
  return {first, second};
}

std::string read_multipliers_on(const Node& entry, const ContactSpec& contact) {
  const Node* node = find(entry, "multipliers_on");
  if (node == nullptr) return {};
  const auto& [first, second] = contact.between;
  if (name(*node) != first && node->text != second) {
    const Node& between = *find(entry, "between");
    fail(blame(between, *node).place, node->path, unknown_name("curve of this pair", node->text, {first, second}));
  }
  return node->text;
}

// A word, or a length that is not drawn.
void read_initial_gap(const Node* node, ContactSpec& contact) {
  if (node == nullptr) return;
  if (node->kind == Node::Kind::number) {
    contact.clearance = number(*node);
    return;
  }
  if (node->kind != Node::Kind::string) fail(*node, "expected a length or a word, found " + describe(*node));
  contact.initial_gap =
      choice(node, {InitialGap::curve, InitialGap::measured, InitialGap::closed}, contact.initial_gap);
}

}  // namespace

void read_contacts(const Node& root, Scene& scene) {
  Once once;
  for (const Node* entry : entries(root, "contact")) {
    expect_keys(*entry, {"between", "within", "condition", "initial_gap", "multipliers_on"});
    ContactSpec contact;
    contact.key = locate(*entry);
    contact.between = read_between(require(*entry, "between", "a list of two physical curves"), *entry, once);
    if (const Node* within = find(*entry, "within")) {
      contact.within = positive_number(*within);
      if (!is_pattern(contact.between[0]) && !is_pattern(contact.between[1]))
        fail(*within, "goes with between = patterns, such as [\"block_*\", \"block_*\"], whose pairs are found");
    }
    contact.condition =
        choice(find(*entry, "condition"), {Condition::unilateral, Condition::bilateral}, contact.condition);
    read_initial_gap(find(*entry, "initial_gap"), contact);
    contact.multipliers_on = read_multipliers_on(*entry, contact);
    scene.contacts.push_back(contact);
  }
}

}  // namespace mortise::scene_file
