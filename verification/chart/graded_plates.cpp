#include "graded_plates.hpp"

#include <cmath>

#include "support/two_plates.hpp"

namespace mortise::chart {
namespace {

double value_of(const std::map<std::string, double>& parameters, const std::string& name, double otherwise) {
  const auto found = parameters.find(name);
  return found == parameters.end() ? otherwise : found->second;
}

CellKind kind_of(const std::map<std::string, double>& parameters) {
  const bool quadratic = value_of(parameters, "order", 2) == 2;
  if (value_of(parameters, "kind", 0) == 1) return quadratic ? CellKind::tri6 : CellKind::tri3;
  if (!quadratic) return CellKind::quad4;
  return value_of(parameters, "nine_node", 0) == 1 ? CellKind::quad9 : CellKind::quad8;
}

// Vertices k / n go where `move` says, what lies half way between two of them stays half way.
double moved(double t, int n, const std::function<double(double)>& move) {
  const double k = std::floor(t * n + 0.25);
  if (std::abs(t * n - k) < 0.25) return move(k / n);
  return (move(k / n) + move((k + 1) / n)) / 2;
}

}  // namespace

Mesh graded_plates(const std::function<double(double)>& height, const std::map<std::string, double>& parameters,
                   double grading) {
  test::TwoPlates plates;
  plates.height = height;
  plates.n_upper = int(value_of(parameters, "n_upper", 80));
  plates.n_lower = int(value_of(parameters, "n_lower", 100));
  plates.kind_upper = plates.kind_lower = kind_of(parameters);
  Mesh mesh = test::mesh_of(plates);
  const auto along = [&](double t) {
    return t < 0.5 ? std::pow(2 * t, grading) / 2 : 1 - std::pow(2 - 2 * t, grading) / 2;
  };
  const auto away = [&](double t) { return std::pow(t, grading); };  // from the contact line
  std::vector<int> body(std::size_t(mesh.nodes.rows()), 0);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) body[cell.nodes[a]] = cell.body;
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
    const bool upper = body[i] == 0;
    const int columns = upper ? plates.n_upper : plates.n_lower, rows = std::max(1, int(0.375 * columns + 0.5));
    const double x = mesh.nodes(i, 0), far = upper ? plates.top : plates.bottom;
    const double b = (mesh.nodes(i, 1) - height(x)) / (far - height(x));
    const double moved_x = plates.width * moved(x / plates.width, columns, along), line = height(moved_x);
    mesh.nodes.row(i) << moved_x, line + moved(b, rows, away) * (far - line);
  }
  return mesh;
}

}  // namespace mortise::chart
