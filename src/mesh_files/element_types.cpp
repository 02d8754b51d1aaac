#include "mesh_files/element_types.hpp"

#include <map>
#include <vector>

namespace mortise {
namespace {

using enum ElementShape;

// Of each shape: the number of a kind, its nodes, the number of the next ... From gmsh 4.8
// (gmsh::model::mesh::getElementProperties).
const std::map<ElementShape, std::vector<int>> numbers_and_nodes{
    {point, {15, 1}},
    {line, {1, 2, 8, 3, 26, 4, 27, 5, 28, 6, 62, 7, 63, 8, 64, 9, 65, 10, 66, 11, 84, 1}},
    {triangle, {2,  3,  9,  6,  20, 9,  21, 10, 22, 12, 23, 15, 24, 15, 25, 21, 42, 28, 43,
                36, 44, 45, 45, 55, 46, 66, 52, 18, 53, 21, 54, 24, 55, 27, 56, 30, 85, 1}},
    {quadrilateral, {3,  4,  10, 9,  16, 8,   36, 16,  37, 25, 38, 36, 39, 12, 40, 16, 41, 20, 47, 49,
                     48, 64, 49, 81, 50, 100, 51, 121, 57, 24, 58, 28, 59, 32, 60, 36, 61, 40, 86, 1}},
    {tetrahedron, {4,   4,  11,  10, 29,  20, 30, 35, 31, 56, 32, 22, 33, 28, 71, 84, 72, 120, 73,
                   165, 74, 220, 75, 286, 79, 34, 80, 40, 81, 46, 82, 52, 83, 58, 87, 1,  137, 16}},
    {pyramid, {7,   5,   14,  14, 19,  13, 118, 30, 119, 55, 120, 91, 121, 140, 122, 204, 123, 285,
               124, 385, 125, 21, 126, 29, 127, 37, 128, 45, 129, 53, 130, 61,  131, 69,  132, 1}},
    {prism, {6, 6, 13, 18, 18, 15, 89, 1}},
    {hexahedron, {5,  8,   12, 27,   17, 20, 88,  1,  92,  64, 93,  125, 94,  216, 95,  343, 96,  512,
                  97, 729, 98, 1000, 99, 32, 100, 44, 101, 56, 102, 68,  103, 80,  104, 92,  105, 104}}};

const std::map<int, ElementType>& types() {
  static const auto all = [] {
    std::map<int, ElementType> types;
    for (const auto& [shape, list] : numbers_and_nodes)
      for (std::size_t k = 0; k < list.size(); k += 2) types[list[k]] = {list[k], shape, list[k + 1]};
    return types;
  }();
  return all;
}

}  // namespace

int ElementType::dimension() const { return shape == point ? 0 : shape == line ? 1 : shape <= quadrilateral ? 2 : 3; }

std::string ElementType::name() const {
  static constexpr const char* names[] = {"Point",       "Line",    "Triangle", "Quadrilateral",
                                          "Tetrahedron", "Pyramid", "Prism",    "Hexahedron"};
  if (shape == point) return "Point";
  const bool incomplete = number == 24 || number == 40 || number == 53 || number == 60;
  return names[int(shape)] + (" " + std::to_string(node_count)) + (incomplete ? "I" : "");
}

const ElementType* element_type(int number) {
  const auto found = types().find(number);
  return found == types().end() ? nullptr : &found->second;
}

int cell_type(CellKind kind) {
  switch (kind) {
    case CellKind::tri3:
      return 2;
    case CellKind::tri6:
      return 9;
    case CellKind::quad4:
      return 3;
    case CellKind::quad8:
      return 16;
    case CellKind::quad9:
      return 10;
  }
  return 0;  // no kind
}

std::optional<CellKind> cell_kind(int number) {
  for (const CellKind kind : all_cell_kinds)
    if (cell_type(kind) == number) return kind;
  return std::nullopt;
}

int deck_cell_type(int nodes) {
  for (const CellKind kind : all_cell_kinds)
    if (node_count(kind) == nodes && kind != CellKind::quad9) return cell_type(kind);
  return 0;
}

}  // namespace mortise
