#include "app/solve_system.hpp"

#include <cmath>

#include "app/short_edges.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "ddm/solve_feti.hpp"
#include "ddm/substructures.hpp"
#include "fem/motion_sets.hpp"
#include "mesh/slenderness.hpp"
#include "preprint_solvers/mssor.hpp"
#include "preprint_solvers/solve_ddm.hpp"
#include "problem/dirichlet_neumann.hpp"
#include "solve/contact_factor.hpp"
#include "solve/layered_system.hpp"
#include "solve/multipoint_system.hpp"
#include "solve/solve_layers.hpp"

namespace mortise {
namespace {

std::string near_node(const Mesh& mesh, int node) { return near_point(mesh.nodes.row(node).transpose()); }

std::string dependent_row(const Mesh& mesh, const std::vector<ContactPair>& pairs, const Solution& solution) {
  std::size_t k = pairs.size() - 1;
  while (pairs[k].first_row > solution.failed_at) --k;
  return pairs[k].spec.key + ": the contact condition " + near_node(mesh, row_nodes(pairs)[solution.failed_at]) + " " +
         (solution.advice.empty()
              ? "already follows from the others: prescribed displacements or other contact pairs hold the "
                "same nodes; put the multipliers on the other curve or release the prescribed displacement"
              : solution.advice);
}

[[noreturn]] void refuse_unconstrained(const Problem& p, const Solution& solution) {
  std::vector<SizeLayers> shorter = edges_that_carry(p);
  const std::string expected =
      !shorter.empty()
          ? " on this mesh; expected shorter edges where contact ends, whose pressures would carry the load"
          : "; expected a load that presses it on, or prescribed displacements that hold it";
  const auto motion = motions_through(p.mesh, p.floating.motions, p.floating.grounded, solution.driven_mode)[0];
  const std::string text =
      "nothing holds " + describe(p.mesh, motion) + ": the load moves it away from the contact" + expected;
  if (shorter.empty()) throw SceneError(text);
  throw EdgesTooLong(text, std::move(shorter));
}

}  // namespace

// Both by operations for each set of closed rows. Direct: a dense factor of the rows. FETI: so many steps, each of them
// twice through the factors of the parts, which wait for memory where a dense one does not (docs/solver.md).
Solver solver_for(const Method& method, const SaddlePointSystem& system) {
  constexpr double steps = 150, waits = 10;
  if (method.solver) return *method.solver;
  const double rows = double(system.B.rows()), unknowns = double(system.K.cols());
  const int parts = part_count(system.K);
  if (parts < 3) return Solver::direct;
  const double entries = 4 * unknowns * std::log2(unknowns / parts);  // by nested dissection in the plane (George 1973)
  return std::pow(rows, 3) / 3 > steps * waits * 4 * entries ? Solver::feti : Solver::direct;
}

Solution SystemSolver::solve() {
  const auto& multipoint = system_.constraints.multipoint;
  if (!multipoint) return solve_layered(system_);
  if (!independent_) {
    independent_ = std::make_unique<SaddlePointSystem>(independent_system(system_));
  } else {
    independent_->f = multipoint->T.transpose() * system_.f;
    independent_->g = system_.g;
    independent_->constraints.value = system_.constraints.value;
    independent_->start = system_.start;
  }
  Solution solution = solve_layered(*independent_);
  if (solution.u.size() > 0) solution.u = multipoint->T * solution.u;
  solution.unbalanced.resize(0);
  if (solution.factor) solution.factor = std::make_shared<MultipointFactor>(multipoint->T, solution.factor);
  return solution;
}

Solution SystemSolver::solve_layered(const SaddlePointSystem& system) {
  const Eigen::Index count = system.layers.B.cols(), unknowns = system.f.size();
  if (count == 0) return solve_independent(system);
  const auto solve_anew = [&](SaddlePointSystem layered) {
    direct_.reset();
    layered_ = std::make_unique<SaddlePointSystem>(std::move(layered));
    return solve_independent(*layered_);
  };
  Solution solution;
  if (!system.layers.are_linear()) {
    solution = solve_layers(system, solve_anew);
  } else if (!layered_) {
    solution = solve_anew(layered_system(system, layer_stiffness(system.layers, VecX::Zero(count))));
  } else {
    take_loads(system, *layered_);
    solution = solve_independent(*layered_);
  }
  if (solution.u.size() > 0) {
    solution.compression = solution.u.segment(unknowns, count);
    solution.u.conservativeResize(unknowns);
  }
  solution.unbalanced.resize(0);
  if (solution.factor)
    solution.factor = std::make_shared<MultipointFactor>(without_layers(unknowns, layered_->f.size()), solution.factor);
  return solution;
}

Solution SystemSolver::solve_by_factor(const SaddlePointSystem& system) {
  if (!direct_) direct_.emplace(system);
  return direct_->solve();
}

Solution SystemSolver::solve_independent(const SaddlePointSystem& system) {
  const Solver solver = direct_ ? Solver::direct : solver_for(method_, system);  // one that has the factor goes on
  Solution solution;
  switch (solver) {
    case Solver::direct:
      solution = solve_by_factor(system);
      break;
    case Solver::mssor:
      solution = solve_by_mssor(system, method_.mssor);
      break;
    case Solver::ddm:
      solution = solve_by_ddm(system, unknowns_of(mesh_, dirichlet_), method_.ddm);
      break;
    case Solver::feti:
      solution = solve_by_feti(system, method_.feti, slenderness(mesh_));
      break;
  }
  solution.solver = solver;
  if (method_.solver || solver != Solver::feti || solution.status != SolveStatus::not_converged) return solution;
  solution = solve_by_factor(system);  // conjugate gradients may not end
  solution.solver = Solver::direct;
  return solution;
}

void require_solution(const Problem& p, const Solution& solution) {
  switch (solution.status) {
    case SolveStatus::converged:
    case SolveStatus::not_converged:
    case SolveStatus::diverged:
      return;
    case SolveStatus::not_positive_definite:
      throw SceneError("the stiffness is not positive definite " + near_node(p.mesh, solution.failed_at / 2) +
                       ": a part of a body that nothing holds, or elements far out of shape there");
    case SolveStatus::dependent_row:
      throw SceneError(dependent_row(p.mesh, p.pairs, solution));
    case SolveStatus::unconstrained:
      refuse_unconstrained(p, solution);
    case SolveStatus::in_tension:
      throw SceneError(solution.advice);
  }
}

}  // namespace mortise
