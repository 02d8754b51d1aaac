#include "solve/active_set.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "solve/coarse_rows.hpp"
#include "solve/dense_rows.hpp"
#include "solve/interior_point.hpp"
#include "solve/open_motions.hpp"

namespace mortise {
namespace {

constexpr double least_penetration = 1e-11;  // of the largest displacement
constexpr int most_descents = 60;            // what random assemblies take in all is 47
constexpr double without_pressure = 1e-8;    // of the largest: rows that are closed again if they must be

// Unilateral rows that must not stay as they are: closed and in tension, or open and penetrated; `step` has the most of
// both.
std::vector<int> infeasible_rows(const ContactRows& rows, const ContactRows::Answer& answer,
                                 const std::vector<char>& active, ActiveSetStep& step) {
  const double least_opening = 1e-8 * largest_entry(answer.opening);
  std::vector<int> infeasible;
  for (Eigen::Index a = 0; a < answer.w.size(); ++a) {
    step.active += active[a];
    if (!rows.unilateral()[a]) continue;
    const double stress = answer.lambda(a) / rows.scale()(a), w = answer.w(a), driven = answer.opening(a);
    if (active[a]) {
      step.tension = std::max(step.tension, stress);
      if (stress > answer.negligible_tension) infeasible.push_back(int(a));
      continue;
    }
    step.penetration = std::max(step.penetration, -w);
    if (std::abs(driven) > least_opening ? driven < 0 : w < -answer.negligible_penetration)
      infeasible.push_back(int(a));
  }
  return infeasible;
}

// Solves with r.active closed; false if that is the end: the solution is not finite, an iteration inside ended early,
// or no row is infeasible. `at`: as of ContactRows::solve; where it is given, free motions may leave it for open rows'
// sake. `tension`: which is none, as what the rows say is.
bool look(ContactRows& rows, const VecX& at, ActiveSetResult& r, ContactRows::Answer& answer, double tension = 0) {
  const auto solve = [&](const VecX& from) {
    answer = rows.solve(r.active, from);
    answer.negligible_tension = std::max(answer.negligible_tension, tension);
  };
  solve(at);
  const auto penetrated = [&](int a) { return !r.active[a]; };
  for (bool may_move = at.size() > 0;; may_move = false) {
    r.infeasible.clear();
    r.status = answer.status;
    r.dependent_row = answer.dependent_row;
    r.negligible_tension = answer.negligible_tension;
    r.lambda = answer.lambda;
    r.mu = answer.mu;
    r.driven_mode = answer.driven_mode;
    if (r.status != SolveStatus::converged) return false;
    r.status = SolveStatus::not_converged;
    if (!r.lambda.allFinite() || !r.mu.allFinite() || !answer.w.allFinite()) return false;
    r.infeasible = infeasible_rows(rows, answer, r.active, r.steps.emplace_back());
    if (!may_move || r.driven_mode.any() || std::ranges::none_of(r.infeasible, penetrated)) break;
    const MatX free = rows.free_motions();
    if (free.cols() == 0) break;
    const VecX moved = least_motions(rows, r.mu, free, answer.w, r.active);
    if (moved == r.mu) break;
    solve(moved);
  }
  if (!r.infeasible.empty()) return true;
  r.status = r.driven_mode.any() ? SolveStatus::unconstrained : SolveStatus::converged;
  return false;
}

void change(const std::vector<int>& changed, ActiveSetResult& r) {
  r.steps.back().changed = int(changed.size());
  for (const int a : changed) r.active[a] ^= 1;
}

// The method from a given active set. r.infeasible is empty where it ended, also on a solution that is not finite or an
// iteration inside that ended early (not_converged). `at`: as of ContactRows::solve.
void iterate(ContactRows& rows, std::vector<char> start, const VecX& at, int max_steps, int may_stall,
             ActiveSetResult& r) {
  r.active = std::move(start);
  for (std::size_t a = 0; a < r.active.size(); ++a)
    if (!rows.unilateral()[a]) r.active[a] = 1;
  std::size_t fewest = r.active.size() + 1;
  int left = may_stall;
  ContactRows::Answer answer;
  for (int step = 1;; ++step) {
    if (!look(rows, at, r, answer)) {
      if (r.status != SolveStatus::converged || !rows.refine()) return;
      fewest = r.active.size() + 1;
      step = 0;
      continue;
    }
    if (step == max_steps) return;  // the solution belongs to r.active
    if (r.infeasible.size() < fewest) {
      fewest = r.infeasible.size();
      left = may_stall;
    } else if (--left < 0) {
      return;
    }
    change(r.infeasible, r);
  }
}

// The rows that change on the way from pressures `carried`, which carry the load, to those of the closed rows, and how
// far that goes: until rows are without pressure, which open, or to its end, where penetrated rows close. Where the
// closed rows let the load drive a motion, some of `carried` that they are without holds it: the row that does most of
// that closes.
std::vector<int> first_on_the_way(const ActiveSetResult& r, const ContactRows::Answer& to, VecX& carried) {
  if (Eigen::Index most = 0;
      r.driven_mode.any() && carried.cwiseProduct(to.opening).maxCoeff(&most) > 0 && !r.active[most])
    return {int(most)};
  const auto way = [&](int a) { return r.active[a] ? carried(a) / (carried(a) - r.lambda(a)) : 1.0; };
  const double shortest = way(*std::ranges::min_element(r.infeasible, {}, way));
  std::vector<int> changed;
  std::ranges::copy_if(r.infeasible, std::back_inserter(changed), [&](int a) { return way(a) <= shortest; });
  carried += shortest * (r.lambda - carried);
  for (const int a : changed)
    if (r.active[a]) carried(a) = 0;  // not round-off of it, which would close the row again
  return changed;
}

// The active set method of convex programmes (Fletcher, J. Inst. Maths Applics 7 (1971) 76-91) from an interior point.
// Each step lowers the energy, so that no set comes twice but by round-off: then the least tension that opened a row
// since is none.
void descend(ContactRows& rows, const InteriorPoint& from, ActiveSetResult& r) {
  r.active = from.closed;
  VecX carried = from.at.lambda;
  for (Eigen::Index a = 0; a < carried.size(); ++a)
    if (rows.unilateral()[a]) carried(a) = std::min(carried(a), 0.0);
  constexpr double none = std::numeric_limits<double>::infinity();
  ContactRows::Answer answer;
  std::set<std::vector<char>> seen;
  double tension = 0, least = none;
  for (int left = most_descents; left > 0; --left) {
    if (!look(rows, from.at.mu, r, answer, tension)) {
      if (r.status != SolveStatus::converged || !rows.refine()) return;
      continue;
    }
    if (!seen.insert(r.active).second && least < none) {
      tension = std::exchange(least, none);
      seen.clear();
      continue;
    }
    const std::vector<int> changed = first_on_the_way(r, answer, carried);
    for (const int a : changed)
      if (r.active[a]) least = std::min(least, r.lambda(a) / rows.scale()(a));
    change(changed, r);
  }
}

bool ended(const ActiveSetResult& r) { return r.status != SolveStatus::not_converged || r.infeasible.empty(); }

// No answer may hang on which of the rows that just touch were called closed: rows without pressure are open, and
// motions that no row holds then are the least that leave all of them open.
void move_least(ContactRows& rows, const ActiveSetOptions& options, ActiveSetResult& r) {
  if (rows.motions() == 0) return;
  const ActiveSetResult touching = r;
  const VecX stress = r.lambda.cwiseQuotient(rows.scale());
  if (r.interior_steps == 0 && !(largest_entry(stress) > r.negligible_tension)) return;
  std::vector<char> pressed = r.active;
  for (std::size_t a = 0; a < pressed.size(); ++a)
    if (rows.unilateral()[a] && stress(Eigen::Index(a)) > -without_pressure * largest_entry(stress)) pressed[a] = 0;
  if (pressed == r.active && r.interior_steps == 0) return;
  if (pressed != r.active) iterate(rows, pressed, touching.mu, options.settling_steps, options.settling_steps, r);
  if (r.status == SolveStatus::converged) {
    const MatX free = rows.free_motions();
    if (free.cols() == 0) return;
    const VecX least = least_motions(rows, r.mu, free, rows.gaps({r.lambda, r.mu}), r.active);
    iterate(rows, r.active, least, 1, 0, r);
  }
  if (r.status == SolveStatus::converged) return;
  r = touching;
  rows.solve(r.active, r.mu);  // the rows' own state, of what was found before
}

// The active set of the coarse problems, level upon level, for the rows of `fine`.
std::vector<char> guess(const ComplementarityProblem& fine, const VecX& rhs, const ActiveSetOptions& options,
                        int& steps) {
  std::vector<char> active(fine.scale.size(), 1);
  if (fine.scale.size() < options.few_rows) return active;
  const CoarseRows coarse = join_rows(fine, rhs);
  if (4 * coarse.problem.scale.size() > 3 * fine.scale.size()) return active;
  DenseRows rows(coarse.problem, coarse.rhs);
  ActiveSetResult r;
  iterate(rows, guess(coarse.problem, coarse.rhs, options, steps), {}, options.max_steps, options.max_stalled_steps, r);
  steps += int(r.steps.size());
  if (r.status == SolveStatus::dependent_row) return active;
  for (std::size_t a = 0; a < active.size(); ++a) active[a] = r.active[coarse.group[a]];
  return active;
}

void find(ContactRows& rows, std::vector<char> start, const ActiveSetOptions& options, ActiveSetResult& r) {
  iterate(rows, std::move(start), {}, options.max_steps, options.max_stalled_steps, r);
  if (ended(r)) return;
  const InteriorPoint point = find_interior_point(rows);
  r.interior_steps = point.steps;
  if (!point.converged && (r.driven_mode = driven_motions(rows)).any()) {
    r.status = SolveStatus::unconstrained;
    return;
  }
  descend(rows, point, r);
}

}  // namespace

ActiveSetResult find_active_set(ContactRows& rows, std::vector<char> start, const ActiveSetOptions& options) {
  ActiveSetResult r;
  find(rows, std::move(start), options, r);
  if (r.status != SolveStatus::converged) return r;
  move_least(rows, options, r);
  r.free_motions = rows.free_motions();
  return r;
}

ActiveSetResult find_active_set(const ComplementarityProblem& p, const VecX& rhs, const std::vector<char>& start,
                                const ActiveSetOptions& options) {
  ActiveSetResult r;
  if (p.scale.size() == 0) {  // no contact
    r.system.emplace(p.compliance, rhs.size(), std::vector<int>{});
    r.mu = VecX::Zero(rhs.size());
    r.status = SolveStatus::converged;
    return r;
  }
  DenseRows rows(p, rhs);
  const std::vector<char> first = start.empty() ? std::vector<char>(p.scale.size(), 1) : start;
  const bool correction = p.known.size() > 0;
  if (correction)
    descend(rows, {.at = {.lambda = p.known, .mu = VecX::Zero(rows.motions())}, .closed = first}, r);
  else
    iterate(rows, first, {}, options.start_steps, options.max_stalled_steps, r);
  if (!ended(r) && !correction) {
    std::vector<char> next = guess(p, rhs, options, r.coarse_steps);
    if (next == r.active)  // nothing learned
      for (const int a : r.infeasible) next[a] ^= 1;
    for (std::size_t a = 0; a < next.size(); ++a) r.steps.back().changed += next[a] != r.active[a];
    find(rows, std::move(next), options, r);
  }
  if (r.status == SolveStatus::converged) {
    if (!correction) move_least(rows, options, r);
    r.free_motions = rows.free_motions();
  }
  r.system = rows.take_system();
  return r;
}

bool is_infeasible(const SaddlePointSystem& s, const Solution& solution, double tension) {
  if (s.unilateral.empty()) return false;
  const VecX w = (s.B * solution.u - s.g).cwiseQuotient(s.row_scale);
  const double penetration = least_penetration * largest_entry(solution.u);
  for (Eigen::Index a = 0; a < w.size(); ++a)
    if (s.unilateral[a] && (solution.active[a] ? solution.lambda(a) > tension : w(a) < -penetration)) return true;
  return false;
}

void take_active_set(const SaddlePointSystem& s, const ActiveSetResult& set, Solution& solution) {
  solution.status = set.status;
  solution.active = set.active;
  for (ActiveSetStep step : set.steps) {
    step.tension *= s.stiffness_scale;
    solution.steps.push_back(step);
  }
  solution.coarse_steps += set.coarse_steps;
  solution.interior_steps += set.interior_steps;
  solution.infeasible = set.infeasible;
  solution.driven_mode = set.driven_mode;
  solution.rigid_modes = set.free_motions;
  solution.failed_at = set.dependent_row;
}

}  // namespace mortise
