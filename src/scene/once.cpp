#include "scene/once.hpp"

#include "scene/fail.hpp"

namespace mortise::scene_file {

void Once::take(const std::string& what, const Node& node, const Node& entry) {
  const auto [first, is_new] = takers_.try_emplace(what, Taker{&node, &entry});
  if (is_new) return;
  const bool blames_first = &blame(*first->second.node, node) == first->second.node;
  const Node& guilty = blames_first ? *first->second.node : node;
  const Node& other = blames_first ? entry : *first->second.entry;
  fail(guilty, what + " twice; expected once, but it does so in " + locate(other) + " too");
}

}  // namespace mortise::scene_file
