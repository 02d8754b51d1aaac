// [accuracy]
#include <algorithm>
#include <limits>

#include "model/patterns.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

// What only some goals have.
void check_goal(const Node& node, const AccuracySpec& accuracy) {
  const auto goes_with = [&](const char* name, bool fits, const char* goals) {
    if (const Node* given = find(node, name); given && !fits) fail(*given, std::string("goes with of = ") + goals);
  };
  const bool mean = accuracy.of == Goal::mean, place = accuracy.of == Goal::displacement || accuracy.of == Goal::stress;
  goes_with("pair", mean || accuracy.of == Goal::force, "\"mean\" or \"force\"");
  goes_with("window", mean, "\"mean\"");
  goes_with("at", place, "\"displacement\" or \"stress\"");
  goes_with("body", place, "\"displacement\" or \"stress\"");
  if (place) require(node, "at", "[x, y], a place in a body");
  if (!mean) return;
  const Node& window = require(node, "window", "[from, to], arc lengths along the contact line");
  if (!(accuracy.window(0) < accuracy.window(1)))
    fail(window, "expected [from, to] with from < to, arc lengths along the contact line, found " + describe(window));
}

}  // namespace

Keys accuracy_keys(AccuracySpec& a, int last_pair) {
  return {
      required(key("value", a.value, a_part(),
                   "0 < value < 1 or `\"1%\"`, as `--accuracy 1%`: the pressure to this part, on a mesh that is found "
                   "for it ([accuracy.md](accuracy.md)); the file is a `.geo`, whose own mesh sizes, `Transfinite` and "
                   "`Recombine` do not count",
                   "none: the mesh is the file's"),
               "a part such as 0.01 or \"1%\""),
      key("of", a.of, any_of<Goal>(),
          "what the accuracy is asked of: `\"pressure\"` along all contact lines; `\"peak\"`, the largest $p$, refused "
          "where $p$ has no limit; `\"half_width\"` of every contact, by the edge on which it ends; `\"mean\"`, the "
          "mean $p$ over `accuracy.window`, of rings over its area; `\"force\"` of a pair; `\"displacement\"` (x, y) "
          "or `\"stress\"` (11, 22, "
          "12) at `accuracy.at`, a stress refused at a corner where it has no limit, a displacement where nothing "
          "holds the body against it"),
      key("pair", a.pair, whole_number(0, last_pair), "of `mean` and `force`: the pair, from 0, ties left out"),
      key("window", a.window, a_pair(),
          "of `mean`: `[from, to]`, arc lengths `s` as in contact.csv, along the side with the multipliers",
          "required"),
      key("at", a.at, a_pair(), "of `displacement` and `stress`: `[x, y]`, a place in a body or on its boundary",
          "required"),
      key("body", a.body, a_text(), "the body that has the place, where several do: on a contact line", "the only one"),
      key("exclude", a.exclude, a_part(),
          "0 < part < 1 of the length of a loaded piece, on either side of a point of it where p has no limit: left "
          "out of the norm; beside several points no more in all than beside its two ends; of a pair that carries less "
          "than a third of the asked part of all forces the whole, if it has such a point"),
      key("unknowns_max", a.unknowns_max, whole_number(100, 1000000000),
          "100 to 1e9: no finer mesh is made from one that has as many"),
      key("solves_max", a.solves_max, whole_number(1, 100),
          "1 to 100: so many solves at most, each on a mesh of its own"),
      key("first_edges", a.first_edges, whole_number(2, 1000),
          "2 to 1000: edges of the first mesh along each contact curve"),
      key("recombine", a.recombine, true_or_false(), "`true`: quadrilaterals, with a few triangles between them"),
  };
}

void read_accuracy(const Node& root, Scene& scene) {
  const Node* node = find(root, "accuracy");
  if (node == nullptr) return;
  const bool found = std::ranges::any_of(
      scene.contacts, [](const ContactSpec& c) { return is_pattern(c.between[0]) || is_pattern(c.between[1]); });
  const int last_pair =
      found || scene.contacts.empty() ? std::numeric_limits<int>::max() : int(scene.contacts.size()) - 1;
  AccuracySpec accuracy;
  read(*node, accuracy_keys(accuracy, last_pair));
  if (scene.contacts.empty())
    fail(*node, std::string("the accuracy of the contact pressure is asked for where there is no [[contact]]") +
                    (scene.ties.empty() ? "" : " but tied ones"));
  check_goal(*node, accuracy);
  if (!scene.mesh_file.ends_with(".geo"))
    fail(*node, "a mesh has no geometry to refine; expected mesh.file = a .geo (with a .msh every solve gives bars)");
  if (!scene.copies.empty())
    fail(*node, "a mesh is found for drawn bodies, not for copies (" + scene.copies.front().key +
                    "); expected one or the other (with copies every solve gives bars)");
  scene.accuracy = accuracy;
}

}  // namespace mortise::scene_file
