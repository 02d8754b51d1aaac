// Refusing a scene: one line that says where, what and why; and names that may be used once.
#pragma once

#include <map>
#include <string>

#include "scene/node.hpp"

namespace mortise::scene_file {

/// Throws InputError "FILE:LINE: PATH: TROUBLE", with ":COLUMN" behind the line if it is known, or "FILE: --set
/// KEY=VALUE: PATH: TROUBLE" for an override. Control characters in the parts are escaped, so that it stays one line;
/// long settings and paths are clipped.
[[noreturn]] void fail(const Place& place, const std::string& path, const std::string& trouble);
[[noreturn]] void fail(const Node& node, const std::string& trouble);

/// The value for messages: -3, 'abc', ['left', 'right'] or "a table"; long ones are clipped.
std::string describe(const Node& node);

/// "boundary.2 (line 31)", or "boundary.2 (--set KEY=VALUE)".
std::string locate(const Node& node);

/// The one to blame of two values that do not go together: `second`, unless only `first` comes from an override.
const Node& blame(const Node& first, const Node& second);

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
