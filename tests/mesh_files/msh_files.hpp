// Mesh files for tests: one unit square "body", whose lower side is the boundary "edge".
#pragma once

#include <algorithm>
#include <string>

namespace mortise::test {

inline const std::string square_nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n";
inline const std::string square_elements = "1 1 2 2 1 1 2\n2 3 2 1 1 1 2 3 4\n";

inline std::string count_of(const std::string& lines) {
  return std::to_string(std::count(lines.begin(), lines.end(), '\n'));
}

/// Format 2.2, text.
inline std::string msh_2(const std::string& nodes = square_nodes, const std::string& elements = square_elements) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"edge\"\n2 1 \"body\"\n$EndPhysicalNames\n"
         "$Nodes\n" +
         count_of(nodes) + "\n" + nodes + "$EndNodes\n$Elements\n" + count_of(elements) + "\n" + elements +
         "$EndElements\n";
}

/// The same mesh in format 4.1, text.
inline std::string msh_4() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"edge\"\n2 1 \"body\"\n$EndPhysicalNames\n"
         "$Entities\n0 1 1 0\n1 0 0 0 1 0 0 1 -2 0 \n1 0 0 0 1 1 0 1 1 1 1 \n$EndEntities\n"
         "$Nodes\n2 4 1 4\n1 1 0 2\n1\n2\n0 0 0\n1 0 0\n2 1 0 2\n3\n4\n1 1 0\n0 1 0\n$EndNodes\n"
         "$Elements\n2 2 1 2\n1 1 1 1\n1 1 2 \n2 1 3 1\n2 1 2 3 4 \n$EndElements\n";
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? "(no such text: " + what + ")" : text.replace(at, what.size(), by);
}

}  // namespace mortise::test
