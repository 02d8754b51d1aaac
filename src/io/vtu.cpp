#include "io/vtu.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "base/errors.hpp"

namespace mortise {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

// VTK's numbers of the kinds (vtkCellType.h).
std::uint8_t vtk_type(const Cell& cell) {
  switch (cell.kind) {
    case CellKind::tri3:
      return 5;
    case CellKind::tri6:
      return 22;
    case CellKind::quad4:
      return 9;
    case CellKind::quad8:
      return 23;
    case CellKind::quad9:
      return 28;
  }
  return 0;
}

std::uint8_t vtk_type(const Edge& edge) { return edge.node_count == 3 ? 21 : 3; }

int size_of(const Cell& cell) { return node_count(cell.kind); }
int size_of(const Edge& edge) { return edge.node_count; }

// The XML head with an entry an array, and after it the bytes of the arrays, each behind its length.
class VtuFile {
 public:
  VtuFile(std::size_t points, std::size_t cells) {
    head_ << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
          << "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" << points << "\" NumberOfCells=\"" << cells
          << "\">\n";
  }

  void open(const char* section) { head_ << "      <" << section << ">\n"; }
  void close(const char* section) { head_ << "      </" << section << ">\n"; }

  template <typename Number>
  void add(const std::string& name, const std::vector<Number>& values, Eigen::Index columns = 1,
           const std::vector<std::string>& components = {}) {
    head_ << "        <DataArray type=\"" << type_of(Number()) << "\" Name=\"" << name << "\"";
    if (columns != 1) head_ << " NumberOfComponents=\"" << columns << "\"";
    for (std::size_t i = 0; i < components.size(); ++i)
      head_ << " ComponentName" << i << "=\"" << components[i] << "\"";
    head_ << " format=\"appended\" offset=\"" << data_.size() << "\"/>\n";
    const std::uint64_t bytes = values.size() * sizeof(Number);
    data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    data_.append(reinterpret_cast<const char*>(values.data()), bytes);
  }

  void write(const std::filesystem::path& path) {
    head_ << "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n   _";
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    file << head_.view() << data_ << "\n  </AppendedData>\n</VTKFile>\n";
    file.close();
    if (file) return;
    throw InputError(path.string() + (errno == ENOSPC ? ": no space left on the device" : ": cannot be written"));
  }

 private:
  static const char* type_of(double) { return "Float64"; }
  static const char* type_of(std::int32_t) { return "Int32"; }
  static const char* type_of(std::uint8_t) { return "UInt8"; }

  std::ostringstream head_;
  std::string data_;
};

// A plane vector gets its zero.
void add_rows(VtuFile& file, const std::string& name, const MatX& rows, const std::vector<std::string>& components) {
  const Eigen::Index columns = rows.cols() == 2 ? 3 : rows.cols();
  std::vector<double> values(columns * rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index j = 0; j < rows.cols(); ++j) values[columns * i + j] = rows(i, j);
  file.add(name, values, columns, components);
}

void add_fields(VtuFile& file, const char* section, const std::vector<VtuField>& fields,
                [[maybe_unused]] std::size_t rows) {
  file.open(section);
  for (const VtuField& field : fields) {
    assert(static_cast<std::size_t>(field.values.rows()) == rows && "a row a point or cell");
    add_rows(file, field.name, field.values, field.components);
  }
  file.close(section);
}

// Our node order is VTK's, for cells and edges alike.
template <typename Element>
void add_cells(VtuFile& file, const std::vector<Element>& elements) {
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  for (const Element& element : elements) {
    connectivity.insert(connectivity.end(), element.nodes.begin(), element.nodes.begin() + size_of(element));
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    types.push_back(vtk_type(element));
  }
  file.open("Cells");
  file.add("connectivity", connectivity);
  file.add("offsets", offsets);
  file.add("types", types);
  file.close("Cells");
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const VtuGrid& grid) {
  assert((grid.cells.empty() || grid.edges.empty()) && "cells or edges, not both");
  const std::size_t points = grid.points.rows(), cells = grid.cells.size() + grid.edges.size();
  VtuFile file(points, cells);
  add_fields(file, "PointData", grid.point_fields, points);
  add_fields(file, "CellData", grid.cell_fields, cells);
  file.open("Points");
  add_rows(file, "Points", grid.points, {});
  file.close("Points");
  if (grid.edges.empty()) {
    add_cells(file, grid.cells);
  } else {
    add_cells(file, grid.edges);
  }
  file.write(path);
}

}  // namespace mortise
