// Names that may be used once: a curve in one contact pair, a displacement component on a curve.
#pragma once

#include <map>
#include <string>

#include "scene/document.hpp"

namespace mortise::scene_file {

/// Remembers who took a name first.
class Once {
 public:
  /// Throws if `what` ("curve 'top' carries a load") was taken before. `node` is where that is written now,
  /// `entry` the entry it belongs to, for the message. Both must outlive this object.
  void take(const std::string& what, const Node& node, const Node& entry);

 private:
  struct Taker {
    const Node* node;
    const Node* entry;
  };
  std::map<std::string, Taker> takers_;
};

}  // namespace mortise::scene_file
