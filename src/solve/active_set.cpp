#include "solve/active_set.hpp"

#include "solve/coarse_rows.hpp"

namespace mortise {
namespace {

constexpr double negligible_penetration = 1e-11;  // of the largest term of any w
constexpr int few_stalled_steps = 3;              // before supports come
constexpr double softening = 1e-3;                // of the supports, a few times
constexpr int softenings = 2, max_supports = 8;
constexpr double negligible_support = 1e-10;  // what supports may carry in the end, of the largest load

std::vector<int> active_rows(const std::vector<char>& active) {
  std::vector<int> rows;
  for (std::size_t a = 0; a < active.size(); ++a)
    if (active[a]) rows.push_back(int(a));
  return rows;
}

class DenseRows : public ContactRows {
 public:
  DenseRows(const ComplementarityProblem& problem, const VecX& rhs) : p_(problem), rhs_(rhs) {
    if (p_.round_off > 0)
      negligible_stress_ =
          p_.round_off /
          largest_entry(p_.compliance.topLeftCorner(rows(), rows()).selfadjointView<Eigen::Lower>() * p_.scale);
  }

  Answer solve(const std::vector<char>& closed, const Supports& supports) override {
    closed_ = active_rows(closed);
    system_.emplace(p_.compliance, springs(), closed_, supports.stiffness);
    Answer answer;
    answer.dependent_row = system_->dependent_row();
    if (answer.dependent_row >= 0) {
      answer.status = SolveStatus::dependent_row;
      return answer;
    }
    VecX rhs = rhs_, x = VecX::Zero(rhs_.size());  // x: what is known of it
    const bool correction = p_.known.size() > 0;
    if (correction) {
      for (Eigen::Index a = 0; a < rows(); ++a)
        if (!closed[a]) x(a) = -p_.known(a);
      rhs -= p_.compliance.selfadjointView<Eigen::Lower>() * x;
    }
    if (supports.at.size() > 0) {
      rhs.head(rows()) -= openings(supports.at);
      x.tail(springs()) = supports.at;
    }
    x += system_->solve(rhs);
    const VecX sum = (p_.compliance.selfadjointView<Eigen::Lower>() * x).head(rows()),
               moved = openings(x.tail(springs()));
    answer.w = rhs_.head(rows()) - sum;
    answer.lambda = x.head(rows());
    if (correction) answer.lambda += p_.known;
    answer.mu = x.tail(springs());
    // Springs against unbalanced loads make the terms of w larger than any displacement; 1e-13 of them, a few hundred
    // round-offs, stays negligible.
    const double terms = largest(largest_entry(rhs_.head(rows())), largest_entry(sum)),
                 moved_most = largest(largest_entry(answer.w), largest_entry(moved)),
                 largest_gap = correction       ? p_.displacement
                               : springs() == 0 ? terms
                                                : largest(moved_most, 1e-2 * terms),
                 largest_stress = largest_entry(answer.lambda.cwiseQuotient(p_.scale));
    answer.negligible_tension = std::max(negligible_tension * largest_stress, negligible_stress_);
    answer.negligible_penetration = std::max(negligible_penetration * largest_gap, p_.round_off);
    const VecX load = rhs_.tail(springs()), size = load.cwiseAbs() + Ht().cwiseAbs() * answer.lambda.cwiseAbs();
    answer.supported = fraction(largest_entry(load - Ht() * x.head(rows())), largest_entry(size));
    answer.driven_mode = system_->driven_mode(rhs);
    answer.opening = openings(answer.driven_mode);
    return answer;
  }

  const VecX& scale() const override { return p_.scale; }
  const std::vector<char>& unilateral() const override { return p_.unilateral; }
  Eigen::Index motions() const override { return springs(); }
  VecX stiffness() const override { return Ht().cwiseAbs2() * p_.compliance.diagonal().head(rows()).cwiseInverse(); }

  MatX free_motions() const override { return MultiplierSystem(p_.compliance, springs(), closed_).rigid_modes(); }

  std::optional<MultiplierSystem> take_system() { return std::move(system_); }

 private:
  Eigen::Index rows() const { return p_.scale.size(); }
  Eigen::Index springs() const { return rhs_.size() - rows(); }
  Eigen::Block<const MatX> Ht() const { return p_.compliance.bottomLeftCorner(springs(), rows()); }
  VecX openings(const VecX& motion) const { return Ht().transpose() * motion; }

  const ComplementarityProblem& p_;
  const VecX& rhs_;
  double negligible_stress_ = 0;  // opens no row by more than round-off
  std::vector<int> closed_;
  std::optional<MultiplierSystem> system_;
};

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

enum class Stalled { one_row_at_a_time, gives_up };

// The method from a given active set. r.infeasible is empty where it ended, also on a solution that is not finite or an
// iteration inside that ended early (not_converged).
void iterate(ContactRows& rows, std::vector<char> start, const Supports& supports, int max_steps, Stalled stalled,
             const ActiveSetOptions& options, ActiveSetResult& r) {
  r.active = std::move(start);
  r.infeasible.clear();
  for (std::size_t a = 0; a < r.active.size(); ++a)
    if (!rows.unilateral()[a]) r.active[a] = 1;
  const int may_stall = stalled == Stalled::gives_up ? few_stalled_steps : options.max_stalled_steps;
  std::size_t fewest = r.active.size() + 1;
  int left = may_stall;
  for (int step = 1;; ++step) {
    ContactRows::Answer answer = rows.solve(r.active, supports);
    r.status = answer.status;
    r.dependent_row = answer.dependent_row;
    r.lambda = answer.lambda;
    r.mu = answer.mu;
    r.supported = answer.supported;
    r.driven_mode = answer.driven_mode;
    if (r.status != SolveStatus::converged) return;
    r.status = SolveStatus::not_converged;
    if (!r.lambda.allFinite() || !r.mu.allFinite() || !answer.w.allFinite()) return;
    r.infeasible = infeasible_rows(rows, answer, r.active, r.steps.emplace_back());
    r.status = r.driven_mode.any() ? SolveStatus::unconstrained : SolveStatus::converged;
    if (r.infeasible.empty()) {
      if (r.status == SolveStatus::unconstrained || !rows.refine()) return;
      fewest = r.active.size() + 1;
      continue;
    }
    r.status = SolveStatus::not_converged;
    if (step == max_steps) return;  // the solution belongs to r.active
    if (r.infeasible.size() < fewest) {
      fewest = r.infeasible.size();
      left = may_stall;
    } else if (--left < 0) {
      if (stalled == Stalled::gives_up) return;
      r.infeasible.resize(1);
    }
    r.steps.back().changed = int(r.infeasible.size());
    for (const int a : r.infeasible) r.active[a] ^= 1;
  }
}

bool ended(const ActiveSetResult& r) { return r.status != SolveStatus::not_converged || r.infeasible.empty(); }

// With springs at the free motions, each attached anew where its motion went, softer and softer, until they carry
// nothing. Where they go on carrying something, the load drives it.
void iterate_supported(ContactRows& rows, const ActiveSetOptions& options, ActiveSetResult& r) {
  Supports supports{.stiffness = rows.stiffness(), .at = VecX::Zero(rows.motions())};
  std::vector<char> start(rows.scale().size(), 0);
  for (int stage = 0; stage < max_supports; ++stage) {
    iterate(rows, std::move(start), supports, options.max_steps, Stalled::one_row_at_a_time, options, r);
    if (r.status != SolveStatus::converged || r.supported <= negligible_support) return;
    start = r.active;
    supports.at = r.mu;
    if (stage < softenings) supports.stiffness *= softening;
  }
  iterate(rows, start, {}, options.max_steps, Stalled::gives_up, options, r);
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
  iterate(rows, guess(coarse.problem, coarse.rhs, options, steps), {}, options.max_steps,
          rows.motions() > 0 ? Stalled::gives_up : Stalled::one_row_at_a_time, options, r);
  steps += int(r.steps.size());
  if (r.status == SolveStatus::dependent_row) return active;
  for (std::size_t a = 0; a < active.size(); ++a) active[a] = r.active[coarse.group[a]];
  return active;
}

void find(ContactRows& rows, std::vector<char> start, const ActiveSetOptions& options, ActiveSetResult& r) {
  iterate(rows, std::move(start), {}, options.max_steps,
          rows.motions() > 0 ? Stalled::gives_up : Stalled::one_row_at_a_time, options, r);
  if (ended(r) || rows.motions() == 0) return;
  const std::vector<char> last = r.active;
  iterate_supported(rows, options, r);
  if (!ended(r)) iterate(rows, last, {}, options.max_steps, Stalled::one_row_at_a_time, options, r);
}

}  // namespace

ActiveSetResult find_active_set(ContactRows& rows, std::vector<char> start, const ActiveSetOptions& options) {
  ActiveSetResult r;
  find(rows, std::move(start), options, r);
  if (r.status == SolveStatus::converged) r.free_motions = rows.free_motions();
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
  const std::vector<char> all(p.scale.size(), 1);
  iterate(rows, start.empty() ? all : start, {}, options.start_steps, Stalled::gives_up, options, r);
  if (!ended(r)) {
    std::vector<char> next = guess(p, rhs, options, r.coarse_steps);
    if (next == r.active)  // nothing learned
      for (const int a : r.infeasible) next[a] ^= 1;
    for (std::size_t a = 0; a < next.size(); ++a) r.steps.back().changed += next[a] != r.active[a];
    find(rows, std::move(next), options, r);
  }
  if (r.status == SolveStatus::converged) r.free_motions = rows.free_motions();
  r.system = rows.take_system();
  return r;
}

bool penetrates(const SaddlePointSystem& s, const Solution& solution) {
  if (s.unilateral.empty()) return false;
  const VecX w = (s.B * solution.u - s.g).cwiseQuotient(s.row_scale);
  const double penetration = negligible_penetration * largest_entry(solution.u);
  for (Eigen::Index a = 0; a < w.size(); ++a)
    if (s.unilateral[a] && !solution.active[a] && w(a) < -penetration) return true;
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
  solution.infeasible = set.infeasible;
  solution.driven_mode = set.driven_mode;
  solution.rigid_modes = set.free_motions;
  solution.failed_at = set.dependent_row;
}

}  // namespace mortise
