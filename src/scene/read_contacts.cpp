// [[contact]]
#include <algorithm>
#include <cctype>

#include "model/patterns.hpp"
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

const std::initializer_list<InitialGap> gap_words{InitialGap::curve, InitialGap::measured, InitialGap::closed};

// All names of an expression's are single letters but theta and pi.
bool is_word(const std::string& text) {
  return text.size() > 1 && text != "theta" && text != "pi" &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalpha(c); });
}

// A word, or the gap: a length that may be an expression.
void read_initial_gap(const Node* node, const Scene& scene, ContactSpec& contact) {
  if (node == nullptr) return;
  if (node->kind == Node::Kind::string && is_word(node->text) &&
      std::ranges::none_of(scene.fields, [&](const FieldSpec& f) { return f.function->name == node->text; })) {
    contact.initial_gap = choice(node, gap_words, contact.initial_gap);
    return;
  }
  if (node->kind != Node::Kind::number && node->kind != Node::Kind::string)
    fail(*node, "expected a length, an expression or a word, found " + describe(*node));
  contact.initial_gap = InitialGap::given;
  contact.gap = field(*node, expression_use(scene, true));
}

// What is added to the gap between the drawn curves, or between the edges.
void read_clearance(const Node& entry, const Scene& scene, ContactSpec& contact) {
  const Node* node = find(entry, "clearance");
  if (node == nullptr) return;
  if (contact.initial_gap == InitialGap::closed || contact.initial_gap == InitialGap::given) {
    const Node& gap = *find(entry, "initial_gap");
    fail(blame(gap, *node).place, node->path,
         "is added to the gap that is drawn, but initial_gap = " + describe(gap) + "; expected one of them");
  }
  contact.clearance = field(*node, expression_use(scene, true));
}

}  // namespace

void read_contacts(const Node& root, Scene& scene) {
  Once once;
  for (const Node* entry : entries(root, "contact")) {
    expect_keys(*entry, {"between", "within", "condition", "initial_gap", "clearance", "multipliers_on"});
    ContactSpec contact;
    contact.key = locate(*entry);
    contact.between = read_between(require(*entry, "between", "a list of two physical curves"), *entry, once);
    if (const Node* within = find(*entry, "within")) {
      contact.within = positive_number(*within);
      if (!is_pattern(contact.between[0]) && !is_pattern(contact.between[1]))
        fail(*within, "goes with between = patterns, such as [\"block_*\", \"block_*\"], whose pairs are found");
    }
    contact.condition = choice(find(*entry, "condition"),
                               {Condition::unilateral, Condition::bilateral, Condition::tied}, contact.condition);
    const bool tied = contact.condition == Condition::tied;
    for (const char* key : {"initial_gap", "clearance"})
      if (const Node* node = find(*entry, key); tied && node != nullptr)
        fail(*node, "has no meaning with condition = \"tied\", which makes one body of both; expected one of them");
    read_initial_gap(find(*entry, "initial_gap"), scene, contact);
    read_clearance(*entry, scene, contact);
    contact.multipliers_on = read_multipliers_on(*entry, contact);
    (tied ? scene.ties : scene.contacts).push_back(contact);
  }
}

}  // namespace mortise::scene_file
