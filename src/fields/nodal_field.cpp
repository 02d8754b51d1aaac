#include "fields/nodal_field.hpp"

#include <Eigen/LU>
#include <filesystem>

#include "base/child_process.hpp"
#include "base/errors.hpp"
#include "base/packed.hpp"
#include "base/printable.hpp"
#include "fem/locate.hpp"
#include "fields/csv_points.hpp"
#include "fields/grid_module.hpp"
#include "output/vtu.hpp"

namespace mortise {
namespace {

constexpr double longest_read = 100;  // seconds

class NodalField {
 public:
  NodalField(Mesh mesh, VecX values) : mesh_(std::move(mesh)), values_(std::move(values)), finder_(mesh_) {}
  NodalField(const NodalField&) = delete;
  NodalField& operator=(const NodalField&) = delete;

  /// Taylor's about the place in the cell, which is x itself but beside the boundary.
  double at(const std::string& key, const Vec2& x) const {
    const std::optional<CellPlace> place = finder_.nearest(x);
    if (!place) fail_outside(key, x);
    const Cell& cell = mesh_.cells[place->cell];
    const CellShape shape = cell_shape(cell.kind, place->xi);
    double value = 0;
    Vec2 slope = Vec2::Zero();  // d value / d xi
    for (int a = 0; a < node_count(cell.kind); ++a) {
      value += shape.N[a] * values_[cell.nodes[a]];
      slope += shape.dN[a] * values_[cell.nodes[a]];
    }
    const CellPoint at = cell_point(mesh_.nodes, cell, shape);
    return value + slope.dot(at.x_xi.transpose().inverse() * (x - at.x));
  }

 private:
  [[noreturn]] void fail_outside(const std::string& key, const Vec2& x) const {
    Eigen::Index nearest = 0;
    const double away = (mesh_.nodes.rowwise() - x.transpose()).rowwise().norm().minCoeff(&nearest);
    throw SceneError(worded(key, ": (", x.x(), ", ", x.y(), ") is outside of ", mesh_.source,
                            ", whose nearest point, (", mesh_.nodes(nearest, 0), ", ", mesh_.nodes(nearest, 1),
                            "), is ", away, " away; expected values all over the bodies and curves that take them"));
  }

  Mesh mesh_;
  VecX values_;
  CellFinder finder_;
};

/// The grid and its only field, read in a child process.
VtuGrid read_vtu(const std::string& file, const std::string& name) {
  const GridModule& vtk = grid_module();
  const std::string bytes = run_in_child({.file = file, .library = "VTK", .seconds = longest_read, .limit = ""}, [&] {
    const VtuGrid grid = vtk.read(file, name);
    const MatX& values = grid.point_fields.front().values;
    Packed to;
    to.put(grid.points.data(), std::size_t(grid.points.size()));
    to.put(grid.cells.data(), grid.cells.size());
    to.put(values.data(), std::size_t(values.size()));
    return std::move(to.bytes);
  });
  Unpacked from(bytes);
  const auto points = from.list<double>();
  VtuGrid grid;
  grid.points = Eigen::Map<const Points>(points.data(), std::ssize(points) / 2, 2);
  grid.cells = from.list<Cell>();
  const auto values = from.list<double>();
  const Eigen::Index rows = grid.points.rows(), columns = rows == 0 ? 1 : std::ssize(values) / rows;
  grid.point_fields = {{name, Eigen::Map<const MatX>(values.data(), rows, columns), {}}};
  return grid;
}

std::shared_ptr<NodalField> field_of_vtu(const std::string& file, const std::string& name,
                                         std::optional<int> component) {
  VtuGrid grid = read_vtu(file, name);
  const MatX& values = grid.point_fields.front().values;
  const Eigen::Index components = values.cols();
  if (component ? *component >= components : components != 1)
    throw InputError(file + ": '" + name + "' has " + std::to_string(components) +
                     " components; expected component = 0" +
                     (components > 1 ? " to " + std::to_string(components - 1) : ""));
  if (grid.cells.empty()) throw InputError(file + ": it has no plane cells");
  Mesh mesh;
  mesh.source = file;
  mesh.nodes = std::move(grid.points);
  mesh.cells = std::move(grid.cells);
  return std::make_shared<NodalField>(std::move(mesh), VecX(values.col(component.value_or(0))));
}

std::shared_ptr<NodalField> field_of_csv(const std::string& file, const std::string& column) {
  CsvPoints points = read_csv_points(file, column);
  Mesh mesh;
  mesh.source = file;
  mesh.nodes = std::move(points.points);
  if (mesh.nodes.rows() >= 3)
    for (const auto& [a, b, c] : grid_module().triangulate(mesh.nodes))
      mesh.cells.push_back({CellKind::tri3, 0, {a, b, c}});
  if (mesh.cells.empty()) throw InputError(file + ": expected three points or more that are not on one line");
  return std::make_shared<NodalField>(std::move(mesh), std::move(points.values));
}

}  // namespace

std::function<double(const Vec2&)> nodal_field(const std::string& key, const std::string& file,
                                               const std::string& values, std::optional<int> component) {
  const bool table = std::filesystem::path(file).extension() == ".csv";
  const std::shared_ptr<NodalField> field = table ? field_of_csv(file, values) : field_of_vtu(file, values, component);
  return [key, field](const Vec2& x) { return field->at(key, x); };
}

}  // namespace mortise
