// The module's own side of grid_module.hpp.

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDelaunay2D.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "fields/grid_module.hpp"
#include "output/vtu.hpp"

namespace mortise {
namespace {

/// Keeps VTK's own words off the terminal; the first one is kept.
class Listener : public vtkCommand {
 public:
  static Listener* New() { return new Listener; }
  void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* data) override {
    if (heard.empty()) heard = data ? static_cast<const char*>(data) : "failed";
  }
  std::string heard;
};

/// Lagrange's of first and second order have the nodes of the others, in their order.
std::optional<CellKind> cell_kind(int type, vtkIdType nodes) {
  switch (type) {
    case VTK_TRIANGLE:
      return CellKind::tri3;
    case VTK_QUADRATIC_TRIANGLE:
      return CellKind::tri6;
    case VTK_QUAD:
      return CellKind::quad4;
    case VTK_QUADRATIC_QUAD:
      return CellKind::quad8;
    case VTK_BIQUADRATIC_QUAD:
      return CellKind::quad9;
    case VTK_LAGRANGE_TRIANGLE:
      if (nodes == 3 || nodes == 6) return nodes == 3 ? CellKind::tri3 : CellKind::tri6;
      return std::nullopt;
    case VTK_LAGRANGE_QUADRILATERAL:
      if (nodes == 4 || nodes == 9) return nodes == 4 ? CellKind::quad4 : CellKind::quad9;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

Points plane_points(const std::filesystem::path& path, vtkUnstructuredGrid* grid) {
  Points points(grid->GetNumberOfPoints(), 2);
  double z = 0;
  for (vtkIdType i = 0; i < points.rows(); ++i) {
    const double* x = grid->GetPoint(i);
    points.row(i) << x[0], x[1];
    z = std::max(z, std::abs(x[2]));
  }
  if (!points.allFinite()) throw InputError(path.string() + ": points that are not finite");
  if (points.rows() > 0 && z > 1e-9 * (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm())
    throw InputError(path.string() + ": its points leave the plane z = 0");
  return points;
}

bool has_no_area(int type) {
  constexpr std::array types{VTK_EMPTY_CELL,     VTK_VERTEX,     VTK_POLY_VERTEX,    VTK_LINE,        VTK_POLY_LINE,
                             VTK_QUADRATIC_EDGE, VTK_CUBIC_LINE, VTK_LAGRANGE_CURVE, VTK_BEZIER_CURVE};
  return std::ranges::find(types, type) != types.end();
}

/// Nothing of what the file says is taken for right, as VTK's own access to cells does.
std::vector<Cell> plane_cells(const std::filesystem::path& path, vtkUnstructuredGrid* grid) {
  std::vector<Cell> cells;
  vtkDataArray* const ends = grid->GetCells()->GetOffsetsArray();
  vtkDataArray* const nodes = grid->GetCells()->GetConnectivityArray();
  const vtkIdType count = ends->GetNumberOfTuples() - 1;
  for (vtkIdType e = 0; e < count; ++e) {
    const auto fail = [&](const std::string& trouble) {
      throw InputError(path.string() + ": its cell " + std::to_string(e) + " " + trouble);
    };
    const auto first = vtkIdType(ends->GetComponent(e, 0)), end = vtkIdType(ends->GetComponent(e + 1, 0));
    if (first < 0 || end < first || end > nodes->GetNumberOfTuples() || e >= grid->GetNumberOfCells())
      fail("has points that are not there");
    const int type = grid->GetCellType(e);
    if (has_no_area(type)) continue;
    const std::optional<CellKind> kind = cell_kind(type, end - first);
    if (!kind || end - first != node_count(*kind))
      fail(std::string("is a ") + vtkCellTypes::GetClassNameFromTypeId(type) +
           "; expected triangles of 3 or 6 points, quadrilaterals of 4, 8 or 9");
    Cell cell{*kind, 0, {}};
    for (int a = 0; a < node_count(*kind); ++a) {
      const double node = nodes->GetComponent(first + a, 0);
      if (!(node >= 0 && node < double(grid->GetNumberOfPoints()))) fail("has points that are not there");
      cell.nodes[a] = int(node);
    }
    cells.push_back(cell);
  }
  return cells;
}

VtuField point_field(const std::filesystem::path& path, vtkUnstructuredGrid* grid, const std::string& name) {
  vtkDataArray* const array = grid->GetPointData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfTuples() != grid->GetNumberOfPoints())
    throw InputError(path.string() + ": '" + name + "' is no array of numbers, one a point");
  VtuField field{name, MatX(array->GetNumberOfTuples(), array->GetNumberOfComponents()), {}};
  for (Eigen::Index i = 0; i < field.values.rows(); ++i)
    for (Eigen::Index j = 0; j < field.values.cols(); ++j) field.values(i, j) = array->GetComponent(i, int(j));
  return field;
}

/// Leaves out all arrays but that one.
void select(const std::filesystem::path& path, vtkXMLUnstructuredGridReader* reader, const std::string& name) {
  std::vector<std::string> names;
  for (int k = 0; k < reader->GetNumberOfPointArrays(); ++k) names.emplace_back(reader->GetPointArrayName(k));
  if (names.empty()) throw InputError(path.string() + ": it has no values at its points");
  if (std::ranges::find(names, name) == names.end())
    throw InputError(path.string() + ": " + unknown_name("array of its points", name, names));
  reader->GetCellDataArraySelection()->DisableAllArrays();
  reader->GetPointDataArraySelection()->DisableAllArrays();
  reader->GetPointDataArraySelection()->EnableArray(name.c_str());
}

/// VTK's own words are long, of several lines.
void require_no_error(const std::filesystem::path& path, vtkXMLUnstructuredGridReader* reader,
                      const Listener& listener) {
  if (listener.heard.empty() && reader->GetErrorCode() == 0) return;
  std::string words = listener.heard.substr(0, listener.heard.find_last_not_of(" \n") + 1);
  if (const std::size_t after = words.find("): "); after != std::string::npos) words.erase(0, after + 3);
  throw InputError(path.string() + ": is no .vtu that VTK can read: " + printable(words.substr(0, words.find('\n'))));
}

VtuGrid read(const std::filesystem::path& path, const std::string& array) {
  vtkNew<Listener> listener;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetParserErrorObserver(listener);
  reader->SetReaderErrorObserver(listener);
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->SetFileName(path.c_str());
  try {
    reader->UpdateInformation();
    require_no_error(path, reader, *listener);
    select(path, reader, array);
    reader->Update();
    require_no_error(path, reader, *listener);
    vtkUnstructuredGrid* const grid = reader->GetOutput();
    return {plane_points(path, grid), plane_cells(path, grid), {}, {point_field(path, grid, array)}, {}};
  } catch (const std::length_error&) {
    throw InputError(path.string() + ": is no .vtu that VTK can read");
  } catch (const std::bad_alloc&) {
    throw InputError(path.string() + ": its points and cells need more memory than there is; are their numbers right?");
  }
}

/// In a square of size 1: what VTK takes for the same place is told by lengths.
std::vector<std::array<int, 3>> triangulate(const Points& points) {
  const Eigen::RowVector2d low = points.colwise().minCoeff();
  const double size = (points.colwise().maxCoeff() - low).maxCoeff();
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (const auto& x : points.rowwise()) places->InsertNextPoint((x(0) - low(0)) / size, (x(1) - low(1)) / size, 0);
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(places);
  vtkNew<Listener> listener;
  vtkNew<vtkDelaunay2D> delaunay;
  delaunay->AddObserver(vtkCommand::ErrorEvent, listener);
  delaunay->AddObserver(vtkCommand::WarningEvent, listener);
  delaunay->SetTolerance(1e-12);
  delaunay->SetOffset(100);
  delaunay->SetInputData(cloud);
  delaunay->Update();
  std::vector<std::array<int, 3>> triangles;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType e = 0; e < delaunay->GetOutput()->GetNumberOfCells(); ++e) {
    delaunay->GetOutput()->GetCellPoints(e, nodes);
    const std::array<int, 3> abc{int(nodes->GetId(0)), int(nodes->GetId(1)), int(nodes->GetId(2))};
    const Eigen::RowVector2d u = points.row(abc[1]) - points.row(abc[0]), v = points.row(abc[2]) - points.row(abc[0]);
    const double area = u.x() * v.y() - u.y() * v.x();
    if (std::abs(area) > 1e-12 * (u.squaredNorm() + v.squaredNorm())) triangles.push_back(abc);
  }
  return triangles;
}

}  // namespace
}  // namespace mortise

extern "C" [[gnu::visibility("default")]] const mortise::GridModule mortise_grid;
const mortise::GridModule mortise_grid{mortise::read, mortise::triangulate};
