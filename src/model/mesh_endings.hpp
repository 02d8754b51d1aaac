// The files that a mesh comes from, by the endings of their names.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace mortise {

inline constexpr std::array<std::string_view, 6> mesh_endings{".geo", ".msh", ".inp", ".unv", ".bdf", ".nas"};

/// For messages.
inline constexpr const char* mesh_endings_in_words =
    ".geo or .msh (or .inp of Abaqus or CalculiX, .unv, .bdf or .nas of Nastran)";

inline bool is_mesh_ending(std::string_view ending) {
  return std::ranges::find(mesh_endings, ending) != mesh_endings.end();
}

/// Advice for a file of another ending; may be empty.
inline std::string mesh_ending_advice(std::string_view file) {
  if (file.ends_with(".med")) return "; save it as .unv in Salome (Export, UNV file), which keeps its groups";
  if (file.ends_with(".cgns")) return "; save it as .msh, .unv or .bdf by the program that made it";
  return "";
}

}  // namespace mortise
