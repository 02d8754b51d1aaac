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
  VecX opening;       // m: how the loose motion opens the rows; empty without one, or if the load does not drive it
};

Rows examine(const ComplementarityProblem& p, const ActiveSetResult& r) {
  const Eigen::Index m = p.scale.size(), springs = p.rhs.size() - m;
  Rows rows;
  const VecX closed = (p.compliance.selfadjointView<Eigen::Lower>() * r.solution).head(m);
  rows.w = p.rhs.head(m) - closed;
  rows.w_size = largest(largest_entry(p.rhs.head(m)), largest_entry(closed));
  rows.stress = r.solution.head(m).cwiseQuotient(p.scale);
  if (r.drift.any()) rows.opening = p.compliance.bottomLeftCorner(springs, m).transpose() * r.drift;
  return rows;
}

// A stress that opens no row by more than round-off.
double negligible_stress(const ComplementarityProblem& p) {
  if (p.round_off == 0) return 0;
  const Eigen::Index m = p.scale.size();
  return p.round_off / largest_entry(p.compliance.topLeftCorner(m, m).selfadjointView<Eigen::Lower>() * p.scale);
}

// Unilateral rows that must not stay as they are: closed and pulling, or open and penetrated.
std::vector<int> wrong_rows(const ComplementarityProblem& p, const ActiveSetOptions& options, const Rows& rows,
                            const std::vector<char>& active) {
  const double pull = std::max(options.pull_tolerance * largest_entry(rows.stress), negligible_stress(p));
  const double penetration = std::max(options.penetration_tolerance * rows.w_size, p.round_off);
  const double drift = 1e-8 * largest_entry(rows.opening);
  std::vector<int> wrong;
  for (Eigen::Index a = 0; a < p.scale.size(); ++a) {
    if (!p.unilateral[a]) continue;
    const bool driven = rows.opening.size() > 0 && std::abs(rows.opening(a)) > drift;
    const bool penetrated = driven ? rows.opening(a) < 0 : rows.w(a) < -penetration;
    if (active[a] ? rows.stress(a) > pull : penetrated) wrong.push_back(int(a));
  }
  return wrong;
}

ActiveSetStep describe(const ComplementarityProblem& p, const Rows& rows, const std::vector<char>& active) {
  ActiveSetStep step;
  for (Eigen::Index a = 0; a < p.scale.size(); ++a) {
    step.active += active[a];
    if (!p.unilateral[a]) continue;
    if (active[a])
      step.pull = std::max(step.pull, rows.stress(a));
    else
      step.penetration = std::max(step.penetration, -rows.w(a));
  }
  return step;
}

// Solves with r.active closed. False where its rows depend on one another.
bool solve_closed(const ComplementarityProblem& p, ActiveSetResult& r) {
  r.system.emplace(p.compliance, p.rhs.size() - p.scale.size(), active_rows(r.active));
  r.dependent_row = r.system->dependent_row();
  if (r.dependent_row >= 0) return false;
  r.solution = r.system->solve(p.rhs);
  r.drift = r.system->drift(p.rhs);
  return true;
}

// The method from a given active set. r.wrong is empty where it ended, also on a solution that is not finite
// (not_settled).
void iterate(const ComplementarityProblem& p, std::vector<char> start, int max_steps, const ActiveSetOptions& options,
             ActiveSetResult& r) {
  using Status = ActiveSetResult::Status;
  const std::size_t m = p.scale.size();
  r.active = std::move(start);
  r.wrong.clear();
  for (std::size_t a = 0; a < m; ++a)
    if (!p.unilateral[a]) r.active[a] = 1;
  std::size_t fewest = m + 1;
  int patience = options.patience;
  for (int step = 1;; ++step) {
    r.status = Status::dependent_row;
    if (!solve_closed(p, r)) return;
    r.status = Status::not_settled;
    const Rows rows = examine(p, r);
    if (!r.solution.allFinite() || !rows.w.allFinite()) return;
    r.wrong = wrong_rows(p, options, rows, r.active);
    r.steps.push_back(describe(p, rows, r.active));
    r.status = r.drift.any() ? Status::unheld : Status::settled;
    if (r.wrong.empty()) return;
    r.status = Status::not_settled;
    if (step == max_steps) return;  // the solution belongs to r.active
    if (r.wrong.size() < fewest) {
      fewest = r.wrong.size();
      patience = options.patience;
    } else if (--patience < 0) {
      r.wrong.erase(r.wrong.begin() + 1, r.wrong.end());
    }
    r.steps.back().changed = int(r.wrong.size());
    for (const int a : r.wrong) r.active[a] ^= 1;
  }
}

// The active set of the problem with rows joined, level upon level, for the rows of `fine`.
std::vector<char> guess(const ComplementarityProblem& fine, const ActiveSetOptions& options, int& steps) {
  std::vector<char> active(fine.scale.size(), 1);
  if (fine.scale.size() < options.few_rows) return active;
  const CoarseRows coarse = join_rows(fine);
  if (4 * coarse.scale.size() > 3 * fine.scale.size()) return active;
  ActiveSetResult r;
  iterate(coarse.problem(), guess(coarse.problem(), options, steps), options.max_steps, options, r);
  steps += int(r.steps.size());
  if (r.status == ActiveSetResult::Status::dependent_row) return active;
  for (std::size_t a = 0; a < active.size(); ++a) active[a] = r.active[coarse.group[a]];
  return active;
}

}  // namespace

ActiveSetResult settle_active_set(const ComplementarityProblem& p, const std::vector<char>& start,
                                  const ActiveSetOptions& options) {
  ActiveSetResult r;
  if (p.scale.size() == 0) {  // no contact
    r.system.emplace(p.compliance, p.rhs.size(), std::vector<int>{});
    r.solution = VecX::Zero(p.rhs.size());
    r.status = ActiveSetResult::Status::settled;
    return r;
  }
  const std::vector<char> all(p.scale.size(), 1);
  iterate(p, start.empty() ? all : start, options.start_steps, options, r);
  if (r.status != ActiveSetResult::Status::not_settled || r.wrong.empty()) return r;
  std::vector<char> next = guess(p, options, r.coarse_steps);
  if (next == r.active)  // nothing learned
    for (const int a : r.wrong) next[a] ^= 1;
  for (std::size_t a = 0; a < next.size(); ++a) r.steps.back().changed += next[a] != r.active[a];
  iterate(p, std::move(next), options.max_steps, options, r);
  return r;
}

}  // namespace mortise
