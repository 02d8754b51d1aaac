// The files that a mesh comes from, by the endings of their names.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace mortise {

inline constexpr std::array<std::string_view, 3> mesh_endings{".geo", ".msh", ".inp"};

/// For messages.
inline constexpr const char* mesh_endings_in_words = ".geo or .msh (or .inp of Abaqus or CalculiX)";

inline bool is_mesh_ending(std::string_view ending) {
  return std::ranges::find(mesh_endings, ending) != mesh_endings.end();
}

}  // namespace mortise
