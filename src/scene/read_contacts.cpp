// [[contact]]
#include <algorithm>
#include <cctype>

#include "model/patterns.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

std::array<std::string, 2> read_between(const Node& node, const Node& entry, Once& once) {
  if (node.kind != Node::Kind::list || node.items.size() != 2) fail_expected(node, "a list of two names");
  const std::vector<const Node*> curves = names(node);
  const std::string &first = curves[0]->text, &second = curves[1]->text;
  if (first == second && !is_pattern(first)) fail(node, "expected two different curves, found '" + first + "' twice");
  const auto [one, other] = std::minmax(first, second);
  once.take("the pair of '" + one + "' and '" + other + "' stands", *curves[0], entry);
  return {first, second};
}

void check_multipliers_on(const Node& entry, const ContactSpec& contact) {
  const auto& [first, second] = contact.between;
  const std::string& on = contact.multipliers_on;
  if (on.empty() || on == first || on == second) return;
  const Node& node = *find(entry, "multipliers_on");
  fail(blame(*find(entry, "between"), node).place, node.path, unknown_name("curve of this pair", on, {first, second}));
}

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
    contact.initial_gap = choice<InitialGap>(*node, {InitialGap::curve, InitialGap::measured, InitialGap::closed});
    return;
  }
  if (node->kind != Node::Kind::number && node->kind != Node::Kind::string)
    fail_expected(*node, "a length, an expression or a word");
  contact.initial_gap = InitialGap::given;
  contact.gap = field(*node, expression_use(scene, true));
}

// It is added to a gap that is drawn or measured.
void check_clearance(const Node& entry, const ContactSpec& contact) {
  const Node* node = find(entry, "clearance");
  if (node == nullptr || contact.initial_gap == InitialGap::curve || contact.initial_gap == InitialGap::measured)
    return;
  const Node& gap = *find(entry, "initial_gap");
  fail(blame(gap, *node).place, node->path,
       "is added to the gap that is drawn, but initial_gap = " + describe(gap) + "; expected one of them");
}

// One of pretension and overlap, of a tie.
void check_pretension(const Node& entry, const ContactSpec& contact) {
  for (const char* key : {"pretension", "overlap", "locked"})
    if (const Node* node = find(entry, key); node != nullptr && contact.condition != Condition::tied)
      fail(*node, "goes with condition = \"tied\", a cut through one body that is drawn together");
  if (contact.pretension && contact.overlap)
    fail(*find(entry, "overlap"), "is what a pretension makes; expected one of pretension and overlap");
  if (contact.locked && !contact.pretension)
    fail(*find(entry, "locked"), "goes with pretension, the force before all other loads; overlap is locked by itself");
}

// It presses faces apart that may open.
void check_fluid(const Node& entry, const ContactSpec& contact) {
  const Node* node = find(entry, "fluid");
  if (node == nullptr) return;
  if (contact.condition != Condition::unilateral)
    fail(*node, "goes with condition = \"unilateral\", a gap that may open");
  if (is_pattern(contact.between[0]) || is_pattern(contact.between[1]))
    fail(*node, "goes with between = two curves, not with patterns: it does not get from pair to pair");
}

Keys power_law_keys(Vec2& point, double& exponent) {
  return {required(key("pressure", point.y(), above(0), "that of `overlap`, stress"), "a number > 0"),
          required(key("overlap", point.x(), above(0), "a length"), "a number > 0"),
          required(key("exponent", exponent, from_to(1, 20), "1: in proportion"), "a number from 1 to 20")};
}

// Rows of overlap and pressure; the first may be the origin.
std::vector<Vec2> read_law_table(const Node& node) {
  std::vector<Vec2> points;
  for (const Node& row : node.items) {
    const Vec2 last = points.empty() ? Vec2(0, 0) : points.back(), point = number_pair(row);
    if (&row == &node.items.front() && node.items.size() > 1 && point == last) continue;
    if (!(point.array() > last.array()).all())
      fail_expected(row, points.empty() ? "[overlap, pressure] > 0"
                                        : "[overlap, pressure] above " + describe(*(&row - 1)) + ", the row before");
    points.push_back(point);
  }
  return points;
}

ContactLaw read_law(const Node& node) {
  ContactLaw law{.points = {Vec2(1, 0)}};
  if (node.kind == Node::Kind::number)
    law.points[0].y() = above(0).read(node);
  else if (node.kind == Node::Kind::table)
    read(node, power_law_keys(law.points[0], law.exponent));
  else if (node.kind == Node::Kind::list && !node.items.empty())
    law.points = read_law_table(node);
  else
    fail_expected(node, "a number > 0, a list of rows [overlap, pressure], or { pressure, overlap, exponent }");
  return law;
}

// Of one that no file gave.
std::string trouble_of_law(const ContactLaw& law) {
  Vec2 last(0, 0);
  bool grows = !law.points.empty() && (law.exponent == 1 || law.points.size() == 1);
  for (const Vec2& point : law.points) {
    grows = grows && point.allFinite() && (point.array() > last.array()).all();
    last = point;
  }
  return grows ? from_to(1, 20).trouble(law.exponent)
               : "expected points of overlap and pressure that grow from 0 on, one if there is an exponent";
}

Kind<ContactLaw> a_contact_law() {
  Vec2 point;
  double exponent = 1;
  const Json table = list_of(list_of(a_number().schema, 2, 2), 1);
  return {{{"oneOf", {above(0).schema, table, object_of(power_law_keys(point, exponent))}}}, read_law, trouble_of_law};
}

Keys fluid_keys(FluidSpec& fluid) {
  const Json pair = a_pair().schema;
  Key from{"from", either(pair, list_of(pair, 1)), "`[x, y]`, or a list of such: where it gets in"};
  from.read = [&fluid](const Node& node) { fluid.from = one_or_more_points(node); };
  return {required(key("pressure", fluid.pressure, from_zero(), "its pressure, stress"), "a number >= 0"),
          required(std::move(from), "[x, y], where the fluid gets in, or a list of such")};
}

Kind<FluidSpec> a_fluid() {
  FluidSpec any;
  return {object_of(fluid_keys(any)),
          [](const Node& node) {
            FluidSpec fluid;
            read(node, fluid_keys(fluid));
            return fluid;
          },
          [](const FluidSpec& fluid) { return from_zero().trouble(fluid.pressure); }};
}

}  // namespace

Keys contact_keys(ContactSpec& contact, const FieldUse& use) {
  return {
      required({"between", list_of(a_name().schema, 2, 2),
                "two physical curves, or patterns: then all pairs of two bodies' curves that face each other are in "
                "contact, but for those with an entry of their own; curves of several bodies are none. A curve may be "
                "in several pairs, and one in pieces, as a surface with grooves, is in those of its pieces (`NAME_1`, "
                "`NAME_2` from left to right) that face the other's. Both may be of one body, which touches itself "
                "there: the "
                "ends of a split ring, or the faces of a crack, two curves between the same points"},
               "a list of two physical curves"),
      key("within", contact.within, above(0),
          "of patterns: > 0, how far apart the curves may be where they face each other"
          "; with an accuracy, on any of its meshes. By default also curves further apart that bodies go through one "
          "another at, which are found by another solve",
          "half an edge; tied or closed: what two meshes of one curve differ by"),
      key("condition", contact.condition, any_of<Condition>(),
          "`\"unilateral\"`, `\"bilateral\"`, `\"tied\"` or `\"cyclic\"`. Tied: both bodies are one where their meshes "
          "do not match, in "
          "both components and in tension too. `multipliers_on` names the curve whose nodes follow the other then "
          "(default: that with the shorter edges); no gap, no `contact.csv`, not counted by `accuracy.pair`; the "
          "terminal and summary.json tell the force that goes through. Cyclic: tied to the other turned about the "
          "origin, "
          "as a sector of a disc to the next one"),
      {"initial_gap", a_field(use).schema,
       "`\"curve\"`: between the drawn curves, whatever their meshes (theory, section 9); a length, which may be a "
       "[function of place](#functions-of-place): the gap is that, + open, − overlap, whatever is drawn and meshed; "
       "`\"closed\"`: zero, the curves are one curve (a gap that meshes of one curve cannot show is an error: theory, "
       "section 10); `\"measured\"`: between the edges of the meshes, the preprint's, for studies",
       "`\"curve\"`"},
      key("clearance", contact.clearance, a_field(use),
          "a length, which may be a function of place, that is added to a drawn or measured gap: + open, − overlap",
          "0"),
      key("stiffness", contact.stiffness, a_contact_law(),
          "of rough surfaces, a gasket or a thin layer: the pressure of what the sides overlap (theory, section 5). "
          "$k$ > 0, stress over length: $p = k$ times that; `{ pressure, overlap, exponent }`: $p$ = pressure "
          "(overlapped / overlap)^exponent, exponent from 1 to 20; `[[overlap, pressure], ...]`, both growing: $p$ "
          "goes straight from 0 through these and on beyond the last. By the solvers `direct` and `feti`",
          "none: the sides do not overlap"),
      key("fluid", contact.fluid, a_fluid(),
          "`{ pressure, from }`: a fluid presses both faces apart with `pressure` from the places `from` (`[x, y]` or "
          "a "
          "list of such) on, as far as contact is open or carries less than it ([below](#fluid-in-a-gap))"),
      key("pretension", contact.pretension, a_number(),
          "of a tie along a straight cut, as through the shank of a bolt: the force that draws its faces together "
          "([below](#bolts))"),
      key("locked", contact.locked, true_or_false(),
          "with `pretension`: it is the force before all other loads, and the overlap that it makes stays as they come",
          "`false`: it is the force under all loads"),
      key("overlap", contact.overlap, a_number(),
          "in place of `pretension`: how far the faces are drawn into each other, a length"),
      key("multipliers_on", contact.multipliers_on, a_name(), "one of the two curves",
          "that of the softer body where the other is more than 10 times as stiff (theory, section 13), else, on the "
          "meshes of `[accuracy]`, that which alone is smooth as it is drawn: it does not turn at a place where it "
          "faces the other on both sides, and its curvature does not jump, else that from which the other is not seen "
          "to end and go on farther away, else that of a curve which faces the other on at least 95 % of its length "
          "where the other does so on at most 90 %, else the one with the shorter edges on average, the first if "
          "equal, as on the meshes of `[accuracy]`; but of linear elements the longer edges if they are more than 1.5 "
          "times as long ([stability.md](stability.md)). In domain decomposition: the curve of the body that takes the "
          "displacement, or the coarser one where both bodies take both"),
  };
}

void read_contacts(const Node& root, Scene& scene) {
  Once once;
  for (const Node* entry : entries(root, "contact")) {
    ContactSpec contact;
    read(*entry, contact_keys(contact, expression_use(scene, true)));
    contact.key = locate(*entry);
    contact.entry = int(scene.contacts.size() + scene.ties.size());
    contact.between = read_between(*find(*entry, "between"), *entry, once);
    if (contact.within && !is_pattern(contact.between[0]) && !is_pattern(contact.between[1]))
      fail(*find(*entry, "within"),
           "goes with between = patterns, such as [\"block_*\", \"block_*\"], whose pairs are found");
    const bool cyclic = contact.condition == Condition::cyclic, tied = cyclic || contact.condition == Condition::tied;
    if (cyclic && (scene.model.axisymmetric() || is_pattern(contact.between[0]) || is_pattern(contact.between[1])))
      fail(*find(*entry, "condition"), "is of two curves by their names in a plane model; expected these");
    for (const char* key : {"initial_gap", "clearance", "stiffness", "fluid"})
      if (const Node* node = find(*entry, key); tied && node != nullptr)
        fail(*node, "has no meaning with condition = \"" + to_string(contact.condition) +
                        "\", which makes one body of both; expected one of them");
    check_pretension(*entry, contact);
    check_fluid(*entry, contact);
    read_initial_gap(find(*entry, "initial_gap"), scene, contact);
    check_clearance(*entry, contact);
    check_multipliers_on(*entry, contact);
    (tied ? scene.ties : scene.contacts).push_back(contact);
  }
}

}  // namespace mortise::scene_file
