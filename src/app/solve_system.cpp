#include "app/solve_system.hpp"

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "ddm/solve_feti.hpp"
#include "ddm/substructures.hpp"
#include "fem/edges.hpp"
#include "fem/motion_sets.hpp"
#include "preprint_solvers/mssor.hpp"
#include "preprint_solvers/solve_ddm.hpp"
#include "solve/contact_factor.hpp"
#include "solve/layered_system.hpp"
#include "solve/multipoint_system.hpp"
#include "solve/nonnegative_fit.hpp"
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

// Whether pressures at the ends of segments would carry the load, as those that are spread over edges do not.
bool points_carry(const Problem& p) {
  constexpr double round_off = 1e-8;  // of the largest terms
  const auto& motions = p.floating.motions;
  VecX work = VecX::Zero(Eigen::Index(motions.size()));
  for (const MotionSet& set : motion_sets(p.mesh, motions))
    for (std::size_t k = 0; k < set.motions.size(); ++k)
      for (Eigen::Index i = 0; i < set.fields.rows(); ++i)
        work(set.motions[k]) += set.fields(i, Eigen::Index(k)) * p.discretisation.system.f(set.unknown(i));
  std::vector<VecX> opened;  // by the motions, at each point
  for (const ContactPair& pair : p.pairs) {
    if (pair.spec.condition != Condition::unilateral) return false;
    for (const Segment& segment : find_segments(p.mesh.nodes, pair))
      for (const double xi : {segment.begin, segment.end}) {
        const auto point = contact_point(p.mesh.nodes, pair, segment.edge, xi, segment.opposite_edge);
        if (!point) continue;
        const Vec2 x = edge_point(p.mesh.nodes, pair.multiplier.edges[segment.edge], xi).position;
        VecX& at = opened.emplace_back(VecX::Zero(work.size()));
        for (std::size_t k = 0; k < motions.size(); ++k)
          for (const RigidMotion& part : motions[k])
            at(Eigen::Index(k)) += (int(part.body == pair.multiplier.body) - int(part.body == pair.opposite.body)) *
                                   point->normal.dot(part.at(x));
      }
  }
  MatX A(work.size(), Eigen::Index(opened.size()));
  for (std::size_t i = 0; i < opened.size(); ++i) A.col(Eigen::Index(i)) = opened[i];
  const NonnegativeFit fit = fit_nonnegative(A, work, std::vector<char>(opened.size(), 0));
  return largest_entry(fit.residual) <= round_off * largest_entry(work.cwiseAbs() + A.cwiseAbs() * fit.x);
}

std::string unconstrained(const Problem& p, const Solution& solution) {
  const std::string expected =
      solution.driven_mode.size() > 0 && points_carry(p)
          ? " on this mesh; expected shorter edges where contact ends, whose pressures would carry the load"
          : "; expected a load that presses it on, or prescribed displacements that hold it" +
                (solution.advice.empty() ? std::string() : " (" + solution.advice + ")");
  if (solution.driven_mode.size() == 0) return "contact opens until nothing holds a body" + expected;
  const auto motion = motions_through(p.mesh, p.floating.motions, p.floating.grounded, solution.driven_mode)[0];
  return "nothing holds " + describe(p.mesh, motion) + ": the load moves it away from the contact" + expected;
}

}  // namespace

Solver solver_for(const Method& method, const SaddlePointSystem& system) {
  constexpr int many_rows = 1000, many_parts = 3;
  if (method.solver) return *method.solver;
  return system.B.rows() >= many_rows && part_count(system.K) >= many_parts ? Solver::feti : Solver::direct;
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
  const Solver solver = solver_for(method_, system);
  Solution solution;
  switch (solver) {
    case Solver::direct:
      solution = solve_by_factor(system);
      break;
    case Solver::mssor:
      solution = solve_by_mssor(system, method_.mssor);
      break;
    case Solver::ddm:
      solution = solve_by_ddm(system, dirichlet_, method_.ddm);
      break;
    case Solver::feti:
      solution = solve_by_feti(system, method_.feti);
      break;
  }
  solution.solver = solver;
  if (method_.solver || solver != Solver::feti || solution.status != SolveStatus::not_converged) return solution;
  solution = solve_by_factor(system);  // conjugate gradients may not end
  solution.solver = Solver::direct;
  return solution;
}

Solution solve_system(const Method& method, const SaddlePointSystem& system, const std::vector<char>& dirichlet) {
  return SystemSolver(method, system, dirichlet).solve();
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
      throw SceneError(unconstrained(p, solution));
    case SolveStatus::in_tension:
      throw SceneError(solution.advice);
  }
}

}  // namespace mortise
