#include "preprint_solvers/mssor.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "base/stopwatch.hpp"
#include "preprint_solvers/mssor_sweeps.hpp"
#include "preprint_solvers/tau_limit.hpp"
#include "solve/iteration_monitor.hpp"

namespace mortise {
namespace {

constexpr double tension_tolerance = 1e-9;  // of the largest multiplier, as the check of p >= 0

// Measures iterates of the dimensionless system, and asks the monitor.
struct Watch {
  const SweepSystem& system;
  IterationMonitor& monitor;
  VecX forces = VecX(system.n());  // work space

  // Of the iterate x with residual r; forces are compared with what is known of them without another product: never
  // more than measure_residuals compares them with but where prescribed displacements make them large.
  Residuals measure(const VecX& x, const VecX& r) {
    const Eigen::Index n = system.n(), m = system.m();
    forces.noalias() = system.B.transpose() * x.tail(m);
    const double displacement = largest(largest_entry(x.head(n)), system.largest_value);
    const double size = largest({largest_entry(system.rhs.head(n)), largest_entry(forces),
                                 rigid_part * largest_entry(system.D.cwiseProduct(x.head(n)))});
    return {fraction(largest_entry(r.tail(m)), displacement), fraction(largest_entry(r.head(n)), size)};
  }
  bool go_on(const VecX& x, const VecX& r) { return monitor.go_on(measure(x, r), r.norm()); }
};

void residual(const SweepSystem& s, const VecX& x, VecX& r) {
  multiply(s, x, r);
  r = s.rhs - r;
}

void stationary(SweepPreconditioner& M, Watch& watch, VecX& x, VecX& r) {
  VecX z(x.size());
  while (watch.go_on(x, r)) {
    M.solve(r, z);
    x += z;
    residual(M.system, x, r);
  }
}

// Freund & Nachtigal 1994, algorithm 3.1 without look-ahead. v is the residual of the Lanczos iterate, r that of x.
void symmetric_qmr(SweepPreconditioner& M, Watch& watch, VecX& x, VecX& r) {
  const Eigen::Index size = x.size();
  VecX v = r, z(size), q(size), Aq(size), d = VecX::Zero(size), Ad = d;
  M.solve(v, q);
  double rho = v.dot(q), theta = 0, tau = v.norm();
  while (watch.go_on(x, r) && rho != 0) {
    multiply(M.system, q, Aq);
    const double sigma = q.dot(Aq);
    if (sigma == 0) break;
    const double alpha = rho / sigma, old = theta * theta;
    v -= alpha * Aq;
    theta = v.norm() / tau;
    const double c2 = 1 / (1 + theta * theta);
    tau *= theta * std::sqrt(c2);
    d = c2 * old * d + c2 * alpha * q;
    Ad = c2 * old * Ad + c2 * alpha * Aq;
    x += d;
    r -= Ad;
    M.solve(v, z);
    const double next = v.dot(z);
    q = z + next / rho * q;
    rho = next;
  }
}

// Paige & Saunders 1975, preconditioned as in Elman, Silvester & Wathen 2014, algorithm 4.1; w, Aw: directions and
// their images, newest first.
void minres(SweepPreconditioner& M, Watch& watch, VecX& x, VecX& r) {
  const Eigen::Index size = x.size();
  VecX v = r, older = VecX::Zero(size), next(size), z(size), Az(size);
  VecX w[3] = {VecX::Zero(size), VecX::Zero(size), VecX::Zero(size)}, Aw[3] = {w[0], w[0], w[0]};
  M.solve_blocks(v, z);
  double gamma = std::sqrt(v.dot(z)), gamma_old = 1, eta = gamma, s = 0, s_old = 0, c = 1, c_old = 1;
  while (watch.go_on(x, r) && gamma > 0) {
    z /= gamma;
    multiply(M.system, z, Az);
    const double delta = Az.dot(z);
    next = Az - delta / gamma * v - gamma / gamma_old * older;
    older.swap(v);
    v.swap(next);
    std::swap(w[2], w[1]);
    std::swap(w[1], w[0]);
    std::swap(Aw[2], Aw[1]);
    std::swap(Aw[1], Aw[0]);
    const double a0 = c * delta - c_old * s * gamma, a2 = s * delta + c_old * c * gamma, a3 = s_old * gamma;
    w[0] = z - a3 * w[2] - a2 * w[1];
    Aw[0] = Az - a3 * Aw[2] - a2 * Aw[1];
    M.solve_blocks(v, z);
    gamma_old = gamma;
    gamma = std::sqrt(std::max(0.0, v.dot(z)));
    const double a1 = std::hypot(a0, gamma);
    w[0] /= a1;
    Aw[0] /= a1;
    c_old = c;
    s_old = s;
    c = a0 / a1;
    s = gamma / a1;
    x += c * eta * w[0];
    r -= c * eta * Aw[0];
    eta *= -s;
  }
}

void iterate(Acceleration acceleration, SweepPreconditioner& M, Watch& watch, VecX& x, VecX& r) {
  if (acceleration == Acceleration::none) return stationary(M, watch, x, r);
  if (acceleration == Acceleration::minres) return minres(M, watch, x, r);
  symmetric_qmr(M, watch, x, r);
}

// u and lambda in the system's units.
void set_solution(const SaddlePointSystem& s, const SweepSystem& reduced, const VecX& x, Solution& solution) {
  solution.u = s.constraints.value;
  for (Eigen::Index k = 0; k < reduced.n(); ++k) solution.u(reduced.unknown[k]) = x(k);
  solution.lambda = s.stiffness_scale * x.tail(reduced.m()).cwiseQuotient(s.row_scale);
  solution.active.assign(reduced.m(), 1);
  measure_residuals(s, solution);
}

// Largest tension of a unilateral row.
double tension(const SaddlePointSystem& s, const VecX& lambda) {
  double most = 0;
  for (std::size_t a = 0; a < s.unilateral.size(); ++a)
    if (s.unilateral[a]) most = std::max(most, lambda(a));
  return most;
}

Iteration record(const SweepSystem& reduced, const MssorOptions& options, const IterationMonitor& monitor) {
  Iteration r{.method = "mssor",
              .acceleration = options.acceleration,
              .settings = {},
              .advice = {},
              .tolerance = options.tolerance,
              .steps = monitor.steps(),
              .convergence_rate = monitor.convergence_rate(),
              .history = monitor.history(),
              .figures = {{"omega", options.omega}, {"tau", options.tau}}};
  std::ostringstream settings, advice;
  settings << "omega " << options.omega << ", tau " << options.tau;
  if (options.acceleration == Acceleration::none && reduced.m() > 0) {
    const double limit = tau_limit(reduced, options.omega);
    r.figures.emplace_back("tau_limit", limit);
    settings << " (converges for tau below " << limit << ")";
    advice << "with this omega it converges for tau below " << limit
           << "; acceleration = \"krylov\" converges for any tau, and faster";
  }
  r.settings = settings.str();
  r.advice = advice.str();
  return r;
}

}  // namespace

Solution solve_by_mssor(const SaddlePointSystem& s, const MssorOptions& options) {
  Solution solution;
  Stopwatch watch;
  const SweepSystem reduced = sweep_system(s);
  solution.factorise_seconds = watch.lap();
  if (reduced.not_positive >= 0 || reduced.dependent_row >= 0) {
    solution.status = reduced.not_positive >= 0 ? SolveStatus::not_positive_definite : SolveStatus::dependent_row;
    solution.failed_at = reduced.not_positive >= 0 ? reduced.not_positive : reduced.dependent_row;
    return solution;
  }
  solution.force_tolerance = solution.constraint_tolerance = options.tolerance;
  SweepPreconditioner M{reduced, options.omega, options.tau};
  IterationMonitor monitor(options.tolerance, options.max_iterations);
  Watch steps{reduced, monitor};
  VecX x = VecX::Zero(reduced.rhs.size()), r = reduced.rhs;
  // Where round-off has parted the residual from that of x, or forces are larger than they are compared with here, the
  // iteration starts again from x.
  for (double last = std::numeric_limits<double>::infinity();;) {
    iterate(options.acceleration, M, steps, x, r);
    set_solution(s, reduced, x, solution);
    solution.status = monitor.status();
    const double reached = largest(solution.force_residual, solution.constraint_residual);
    const bool converged = solution.status == SolveStatus::converged;
    if (solution.status == SolveStatus::diverged || monitor.exhausted()) break;
    if (converged && reached <= options.tolerance) break;
    solution.status = SolveStatus::not_converged;
    if (!(reached < last)) break;  // all that this arithmetic gives
    last = reached;
    const double own = monitor.history().back().residuals.largest();  // of the last step, in its measure
    monitor.restart(converged ? 0.5 * std::min(1.0, options.tolerance / reached) * own : monitor.tolerance());
    residual(reduced, x, r);
  }
  if (largest(solution.force_residual, solution.constraint_residual) <= options.tolerance)
    solution.status = SolveStatus::converged;
  solution.iteration = record(reduced, options, monitor);
  const double largest_tension = tension(s, solution.lambda);
  solution.steps.push_back({.active = int(reduced.m()), .tension = largest_tension});
  if (solution.status == SolveStatus::converged &&
      largest_tension > tension_tolerance * largest_entry(solution.lambda)) {
    solution.status = SolveStatus::in_tension;
    solution.advice =
        "method.solver = \"mssor\" is for contact that stays closed, and contact is in tension here; expected solver = "
        "\"direct\", or contact.condition = \"bilateral\"";
  }
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
