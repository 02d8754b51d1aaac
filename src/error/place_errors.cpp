#include "error/place_errors.hpp"

#include "contact/singular_points.hpp"
#include "error/border_overlaps.hpp"
#include "error/corner_cells.hpp"
#include "error/data_works.hpp"
#include "error/estimate_memory.hpp"
#include "error/goal_estimate.hpp"
#include "mesh/boundary_edges.hpp"

namespace mortise {
namespace {

constexpr int most_duals = 8;  // places of a line that have their own

// Which of `count` places have duals: all, or so many even steps along them.
std::vector<int> sampled(int count) {
  std::vector<int> places;
  const int taken = std::min(count, most_duals);
  for (int k = 0; k < taken; ++k) places.push_back(taken == 1 ? 0 : k * (count - 1) / (taken - 1));
  return places;
}

// Of (11, 22, 12), in axes turned by an angle.
Eigen::Matrix3d turning(double angle) {
  Eigen::Matrix3d turn;
  for (int k = 0; k < 3; ++k) {
    Vec4 unit = Vec4::Zero();
    unit(k < 2 ? k : 3) = 1;
    turn.col(k) = in_turned_axes(unit, angle)({0, 1, 3});
  }
  return turn;
}

std::vector<char> boundary_nodes(const Mesh& mesh) {
  std::vector<char> on(mesh.nodes.rows(), 0);
  for (const BoundaryEdge& side : boundary_edges(mesh).edges)
    for (int a = 0; a < side.edge.node_count; ++a) on[side.edge.nodes[a]] = 1;
  return on;
}

bool touches(const Cell& cell, const std::vector<char>& nodes) {
  return std::any_of(cell.nodes.begin(), cell.nodes.begin() + node_count(cell.kind), [&](int a) { return nodes[a]; });
}

// Of each node the largest bar of p on the edges of contact lines that have it, or face it; zero of others.
VecX bars_at_nodes(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                   const std::vector<PressureEstimate>& pressures) {
  VecX bars = VecX::Zero(mesh.nodes.rows());
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const ContactPoint& point : pairs[k].points) {
      const double bar = std::max(pressures[k].bar(point.edge), pressures[k].bar(point.edge + 1));
      for (const Edge& edge : {pairs[k].multiplier.edges[point.edge], pairs[k].opposite.edges[point.opposite_edge]})
        for (int a = 0; a < edge.node_count; ++a) bars(edge.nodes[a]) = std::max(bars(edge.nodes[a]), bar);
    }
  return bars;
}

double largest_at(const Cell& cell, const VecX& at_nodes) {
  double most = 0;
  for (int a = 0; a < node_count(cell.kind); ++a) most = std::max(most, at_nodes(cell.nodes[a]));
  return most;
}

}  // namespace

std::vector<PlaceError> place_errors(const Problem& problem, const Solution& solution,
                                     const std::vector<PressureEstimate>& pressures,
                                     const std::vector<ProbedPlaces>& probes, EstimateMemory& memory) {
  std::vector<PlaceError> errors;
  if (probes.empty()) return errors;
  const Mesh& mesh = problem.mesh;
  const Discretisation& d = problem.discretisation;
  const std::vector<ContactPair>& pairs = problem.pairs;
  const Surroundings around = memory.around(problem);
  const std::shared_ptr<const ContactFactor> factor = contact_factor(d.system, solution);
  const StressPatches patches = recover_patches(mesh, problem.points, sample_stresses(mesh, d.laws, solution.u));
  const std::vector<char> boundary = boundary_nodes(mesh);
  const BorderOverlaps overlaps(problem, solution, pressures);
  const std::vector<int> at_corners = cells_at_corners(problem, pressures, memory);
  const VecX bars_of_p = bars_at_nodes(mesh, pairs, pressures);
  for (const ProbedPlaces& probe : probes) {
    const Eigen::Matrix3d turn = turning(probe.angle);
    const std::vector<int> with_duals = sampled(int(probe.in.size()));
    MatX loads(d.system.K.cols(), 5 * with_duals.size());
    for (std::size_t k = 0; k < with_duals.size(); ++k) {
      const CellPlace& place = probe.in[with_duals[k]];
      loads.middleCols<2>(5 * k) = displacement_loads(mesh, place);
      loads.middleCols<3>(5 * k + 2) = stress_loads(mesh, d, place) * turn.transpose();
    }
    VecX far = VecX::Zero(loads.cols());
    const auto add_lines = [&](Eigen::Index first, const DualSums& duals) {
      const MatX z = duals.fields();
      for (std::size_t k = 0; k < pairs.size(); ++k)
        far.segment(first, z.cols()) +=
            line_part(pairs[k], pressures[k].line, pressures[k].local, openings(pairs[k], z)).sum();
      far.segment(first, z.cols()) += off_by(data_works(problem, solution.u, z));
    };
    const ErrorProducts found = memory.products.with_duals(
        problem, solution.u, factor, {MatX::Zero(d.system.B.rows(), loads.cols()), loads}, add_lines);
    const MatX parts = found.products.rightCols(loads.cols());
    far += off_by(parts) + unseen_at_corners(mesh, at_corners, parts);
    far += overlaps.changes(MatX::Zero(d.system.B.rows(), loads.cols()), loads).colwise().sum().transpose();
    std::size_t next = 0;
    for (int i = 0; i < int(probe.in.size()); ++i) {
      if (with_duals[next] < i) ++next;
      Eigen::Matrix<double, 5, 1> error = far.segment<5>(5 * next);
      if (with_duals[next] > i) error = error.cwiseMax(far.segment<5>(5 * (next - 1)));
      const Eigen::Vector3d local = cell_stress_error(problem, solution.u, patches, probe.in[i], turn);
      error.head<2>().array() += cell_displacement_error(problem, probe.in[i].cell, local);
      error.tail<3>() += local;
      if (touches(mesh.cells[probe.in[i].cell], boundary)) error.tail<3>().array() += probe.spread[i];
      error.tail<3>().array() += largest_at(mesh.cells[probe.in[i].cell], bars_of_p) / error_safety;
      if (singular_exponent(around, pressures, probe.in[i], probe.x[i]))
        error.tail<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
      errors.push_back({error_safety * error.head<2>(), error_safety * error.tail<3>()});
    }
  }
  return errors;
}

}  // namespace mortise
