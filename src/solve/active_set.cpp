#include "solve/active_set.hpp"

#include <algorithm>

#include "solve/coarse_rows.hpp"

namespace mortise {
namespace {

std::vector<int> active_rows(const std::vector<char>& active) {
  std::vector<int> rows;
  for (std::size_t a = 0; a < active.size(); ++a)
    if (active[a]) rows.push_back(int(a));
  return rows;
}

// What one solve says of the rows.
struct Rows {
  VecX w;             // m: what is left open
  VecX stress;        // m: lambda over its scale
  double w_size = 0;  // largest term of any w
  VecX opening;       // m: how the driven mode opens the rows; empty without one
};

Rows examine(const ComplementarityProblem& p, const VecX& rhs, const ActiveSetResult& r) {
  const Eigen::Index m = p.scale.size(), springs = rhs.size() - m;
  Rows rows;
  const VecX closed = (p.compliance.selfadjointView<Eigen::Lower>() * r.solution).head(m);
  rows.w = rhs.head(m) - closed;
  rows.w_size = largest(largest_entry(rhs.head(m)), largest_entry(closed));
  rows.stress = r.solution.head(m).cwiseQuotient(p.scale);
  if (r.driven_mode.any()) rows.opening = p.compliance.bottomLeftCorner(springs, m).transpose() * r.driven_mode;
  return rows;
}

// A stress that opens no row by more than round-off.
double negligible_stress(const ComplementarityProblem& p) {
  if (p.round_off == 0) return 0;
  const Eigen::Index m = p.scale.size();
  return p.round_off / largest_entry(p.compliance.topLeftCorner(m, m).selfadjointView<Eigen::Lower>() * p.scale);
}

// Unilateral rows that must not stay as they are: closed and in tension, or open and penetrated.
std::vector<int> infeasible_rows(const ComplementarityProblem& p, const ActiveSetOptions& options, const Rows& rows,
                                 const std::vector<char>& active) {
  const double tension = std::max(options.tension_tolerance * largest_entry(rows.stress), negligible_stress(p));
  const double penetration = std::max(options.penetration_tolerance * rows.w_size, p.round_off);
  const double least_opening = 1e-8 * largest_entry(rows.opening);
  std::vector<int> infeasible;
  for (Eigen::Index a = 0; a < p.scale.size(); ++a) {
    if (!p.unilateral[a]) continue;
    const bool driven = rows.opening.size() > 0 && std::abs(rows.opening(a)) > least_opening;
    const bool penetrated = driven ? rows.opening(a) < 0 : rows.w(a) < -penetration;
    if (active[a] ? rows.stress(a) > tension : penetrated) infeasible.push_back(int(a));
  }
  return infeasible;
}

ActiveSetStep describe(const ComplementarityProblem& p, const Rows& rows, const std::vector<char>& active) {
  ActiveSetStep step;
  for (Eigen::Index a = 0; a < p.scale.size(); ++a) {
    step.active += active[a];
    if (!p.unilateral[a]) continue;
    if (active[a])
      step.tension = std::max(step.tension, rows.stress(a));
    else
      step.penetration = std::max(step.penetration, -rows.w(a));
  }
  return step;
}

// Solves with r.active closed. False where its rows depend on one another.
bool solve_closed(const ComplementarityProblem& p, const VecX& rhs, ActiveSetResult& r) {
  r.system.emplace(p.compliance, rhs.size() - p.scale.size(), active_rows(r.active));
  r.dependent_row = r.system->dependent_row();
  if (r.dependent_row >= 0) return false;
  r.solution = r.system->solve(rhs);
  r.driven_mode = r.system->driven_mode(rhs);
  return true;
}

// The method from a given active set. r.infeasible is empty where it ended, also on a solution that is not finite
// (not_converged).
void iterate(const ComplementarityProblem& p, const VecX& rhs, std::vector<char> start, int max_steps,
             const ActiveSetOptions& options, ActiveSetResult& r) {
  const std::size_t m = p.scale.size();
  r.active = std::move(start);
  r.infeasible.clear();
  for (std::size_t a = 0; a < m; ++a)
    if (!p.unilateral[a]) r.active[a] = 1;
  std::size_t fewest = m + 1;
  int left = options.max_stalled_steps;
  for (int step = 1;; ++step) {
    r.status = SolveStatus::dependent_row;
    if (!solve_closed(p, rhs, r)) return;
    r.status = SolveStatus::not_converged;
    const Rows rows = examine(p, rhs, r);
    if (!r.solution.allFinite() || !rows.w.allFinite()) return;
    r.infeasible = infeasible_rows(p, options, rows, r.active);
    r.steps.push_back(describe(p, rows, r.active));
    r.status = r.driven_mode.any() ? SolveStatus::unconstrained : SolveStatus::converged;
    if (r.infeasible.empty()) return;
    r.status = SolveStatus::not_converged;
    if (step == max_steps) return;  // the solution belongs to r.active
    if (r.infeasible.size() < fewest) {
      fewest = r.infeasible.size();
      left = options.max_stalled_steps;
    } else if (--left < 0) {
      r.infeasible.erase(r.infeasible.begin() + 1, r.infeasible.end());
    }
    r.steps.back().changed = int(r.infeasible.size());
    for (const int a : r.infeasible) r.active[a] ^= 1;
  }
}

// The active set of the coarse problems, level upon level, for the rows of `fine`.
std::vector<char> guess(const ComplementarityProblem& fine, const VecX& rhs, const ActiveSetOptions& options,
                        int& steps) {
  std::vector<char> active(fine.scale.size(), 1);
  if (fine.scale.size() < options.few_rows) return active;
  const CoarseRows coarse = join_rows(fine, rhs);
  if (4 * coarse.problem.scale.size() > 3 * fine.scale.size()) return active;
  ActiveSetResult r;
  iterate(coarse.problem, coarse.rhs, guess(coarse.problem, coarse.rhs, options, steps), options.max_steps, options, r);
  steps += int(r.steps.size());
  if (r.status == SolveStatus::dependent_row) return active;
  for (std::size_t a = 0; a < active.size(); ++a) active[a] = r.active[coarse.group[a]];
  return active;
}

}  // namespace

ActiveSetResult find_active_set(const ComplementarityProblem& p, const VecX& rhs, const std::vector<char>& start,
                                const ActiveSetOptions& options) {
  ActiveSetResult r;
  if (p.scale.size() == 0) {  // no contact
    r.system.emplace(p.compliance, rhs.size(), std::vector<int>{});
    r.solution = VecX::Zero(rhs.size());
    r.status = SolveStatus::converged;
    return r;
  }
  const std::vector<char> all(p.scale.size(), 1);
  iterate(p, rhs, start.empty() ? all : start, options.start_steps, options, r);
  if (r.status != SolveStatus::not_converged || r.infeasible.empty()) return r;
  std::vector<char> next = guess(p, rhs, options, r.coarse_steps);
  if (next == r.active)  // nothing learned
    for (const int a : r.infeasible) next[a] ^= 1;
  for (std::size_t a = 0; a < next.size(); ++a) r.steps.back().changed += next[a] != r.active[a];
  iterate(p, rhs, std::move(next), options.max_steps, options, r);
  return r;
}

}  // namespace mortise
