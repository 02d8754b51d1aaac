// How bad input is reported: one exception type, and the words for a name that nobody knows.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace mortise {

/// Bad input: a scene, a mesh or a command line that cannot be what its author meant.
/// what() is one line: the file, the place (key, line or coordinates), the value, what was expected.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bad input reported without its file: solve_scene and check_scene put the scene's path before what() and throw that
/// as an InputError.
class SceneError : public InputError {
 public:
  using InputError::InputError;
};

/// What `work` returns. What it refuses becomes a SceneError with `key` before it; one that has its key stays.
template <typename Work>
decltype(auto) told_with_key(const std::string& key, Work work) {
  try {
    return work();
  } catch (const SceneError&) {
    throw;
  } catch (const InputError& error) {
    throw SceneError(key + ": " + error.what());
  }
}

/// The candidate nearest to `name` in edit distance; empty if none is near (more than half of its letters differ).
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

/// "unknown WHAT 'NAME'; did you mean 'NEAREST'? known: a, b, c"; without any candidates "... there is none"
std::string unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& candidates);

}  // namespace mortise
