// The module's own side of vtk_module.hpp.

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cassert>
#include <fstream>

#include "base/errors.hpp"
#include "output/vtk_module.hpp"
#include "output/vtu.hpp"

namespace mortise {
namespace {

unsigned char vtk_type(const Cell& cell) {
  switch (cell.kind) {
    case CellKind::tri3:
      return VTK_TRIANGLE;
    case CellKind::tri6:
      return VTK_QUADRATIC_TRIANGLE;
    case CellKind::quad4:
      return VTK_QUAD;
    case CellKind::quad8:
      return VTK_QUADRATIC_QUAD;
    case CellKind::quad9:
      return VTK_BIQUADRATIC_QUAD;
  }
  return VTK_EMPTY_CELL;
}

unsigned char vtk_type(const Edge& edge) { return edge.node_count == 3 ? VTK_QUADRATIC_EDGE : VTK_LINE; }

int size_of(const Cell& cell) { return node_count(cell.kind); }
int size_of(const Edge& edge) { return edge.node_count; }

/// Our node order is VTK's, for cells and edges alike.
template <typename Element>
void set_cells(vtkUnstructuredGrid* grid, const std::vector<Element>& elements) {
  const auto count = static_cast<vtkIdType>(elements.size());
  vtkIdType size = 0;
  for (const Element& element : elements) size += size_of(element);

  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkTypeInt32Array> offsets;
  vtkNew<vtkTypeInt32Array> connectivity;
  unsigned char* type = types->WritePointer(0, count);
  vtkTypeInt32* offset = offsets->WritePointer(0, count + 1);
  vtkTypeInt32* node = connectivity->WritePointer(0, size);
  vtkTypeInt32 end = 0;
  *offset++ = end;
  for (const Element& element : elements) {
    const int nodes = size_of(element);
    *type++ = vtk_type(element);
    *offset++ = end += nodes;
    for (int i = 0; i < nodes; ++i) *node++ = element.nodes[i];
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  grid->SetCells(types, cells);
}

void set_points(vtkUnstructuredGrid* grid, const Points& points) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  double* xyz = coordinates->WritePointer(0, 3 * points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    *xyz++ = points(i, 0);
    *xyz++ = points(i, 1);
    *xyz++ = 0.0;
  }
  vtkNew<vtkPoints> vtk_points;
  vtk_points->SetData(coordinates);
  grid->SetPoints(vtk_points);
}

/// One byte in front of all other arrays. meshio (5.0 at least) finds an array by its place in the file and gives it a
/// new one, a multiple of 4, as it goes: where the place of a later array is the new one of an earlier, it reads that
/// in its stead. Ours are multiples of 4 bytes long, so behind this byte and its length of 8 no place is a multiple
/// of 4.
void add_byte_in_front(vtkUnstructuredGrid* grid) {
  vtkNew<vtkUnsignedCharArray> byte;
  byte->SetName("mortise");
  byte->InsertNextValue(1);
  grid->GetFieldData()->AddArray(byte);
}

void add_field(vtkDataSetAttributes* attributes, const VtuField& field) {
  const Eigen::Index columns = field.values.cols();
  const Eigen::Index written = columns == 2 ? 3 : columns;
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(static_cast<int>(written));
  for (std::size_t i = 0; i < field.components.size(); ++i) {
    array->SetComponentName(static_cast<vtkIdType>(i), field.components[i].c_str());
  }
  double* value = array->WritePointer(0, written * field.values.rows());
  for (Eigen::Index i = 0; i < field.values.rows(); ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) *value++ = field.values(i, j);
    if (columns == 2) *value++ = 0.0;
  }
  attributes->AddArray(array);
}

/// Keeps VTK's own words off the terminal; its error code says enough.
class Silence : public vtkCommand {
 public:
  static Silence* New() { return new Silence; }
  void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* /*data*/) override {}
};

void write_grid(const std::filesystem::path& path, vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  vtkNew<Silence> silence;
  writer->AddObserver(vtkCommand::ErrorEvent, silence);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silence);
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();  // zlib takes twenty times as long as the disk
  writer->SetHeaderTypeToUInt64();
  const bool written = writer->Write() == 1;
  const unsigned long error = writer->GetErrorCode();
  if (error == vtkErrorCode::OutOfDiskSpaceError) throw InputError(path.string() + ": no space left on the device");
  if (!written || error != vtkErrorCode::NoError) throw InputError(path.string() + ": cannot be written");
}

void write(const std::filesystem::path& path, const VtuGrid& grid) {
  assert((grid.cells.empty() || grid.edges.empty()) && "cells or edges, not both");
  if (!std::ofstream(path, std::ios::binary)) throw InputError(path.string() + ": cannot be written");

  vtkNew<vtkUnstructuredGrid> vtk_grid;
  add_byte_in_front(vtk_grid.Get());
  set_points(vtk_grid, grid.points);
  if (grid.edges.empty()) {
    set_cells(vtk_grid.Get(), grid.cells);
  } else {
    set_cells(vtk_grid.Get(), grid.edges);
  }
  for (const VtuField& field : grid.point_fields) {
    assert(field.values.rows() == grid.points.rows() && "a row a point");
    add_field(vtk_grid->GetPointData(), field);
  }
  for (const VtuField& field : grid.cell_fields) {
    assert(field.values.rows() == static_cast<Eigen::Index>(grid.cells.size() + grid.edges.size()) && "a row a cell");
    add_field(vtk_grid->GetCellData(), field);
  }
  write_grid(path, vtk_grid);
}

}  // namespace
}  // namespace mortise

extern "C" [[gnu::visibility("default")]] const mortise::VtkModule mortise_vtk;
const mortise::VtkModule mortise_vtk{mortise::write};
