#include "solve/saddle_point.hpp"

#include <algorithm>

#include "base/stopwatch.hpp"

namespace mortise {
namespace {

// The system on the free unknowns, dimensionless, as BorderedCholesky wants it: the border is the rows of B and one
// unit row for each spring.
struct Reduced {
  SparseMatrix matrix;
  std::vector<int> free;    // reduced -> full
  std::vector<int> blocks;  // reduced -> node, densely numbered
};

Reduced reduce(const SaddlePointSystem& s) {
  Reduced r;
  const int n = int(s.K.cols());
  std::vector<int> to_reduced(std::size_t(n), -1);
  int last_node = -1, block = -1;
  for (int i = 0; i < n; ++i) {
    if (s.fixed[std::size_t(i)]) continue;
    to_reduced[std::size_t(i)] = int(r.free.size());
    if (i / 2 != last_node) ++block;
    last_node = i / 2;
    r.free.push_back(i);
    r.blocks.push_back(block);
  }
  std::vector<int> spring(std::size_t(n), -1);
  for (std::size_t k = 0; k < s.grounded.size(); ++k) spring[std::size_t(s.grounded[k])] = int(k);

  const int count = int(r.free.size()), m = int(s.B.rows()), border = m + int(s.grounded.size());
  // The columns below the diagonal, read as rows above it: an entry (i, j) goes to column i, and comes in order.
  const auto for_each_entry = [&](auto visit) {
    for (int j = 0; j < count; ++j) {
      const int column = r.free[std::size_t(j)], held = spring[std::size_t(column)];
      for (SparseMatrix::InnerIterator it(s.K, column); it; ++it) {
        const int i = to_reduced[std::size_t(it.row())];
        if (i >= 0) visit(i, j, it.value() / s.stiffness_scale + (i == j && held >= 0 ? 1 : 0));
      }
      for (SparseMatrix::InnerIterator it(s.B, column); it; ++it)
        visit(count + int(it.row()), j, it.value() / s.row_scale(it.row()));
      if (held >= 0) visit(count + m + held, j, 1.0);
    }
    for (int i = count; i < count + border; ++i) visit(i, i, border_diagonal);
  };
  r.matrix.resize(count + border, count + border);
  int* start = r.matrix.outerIndexPtr();
  for_each_entry([&](int i, int, double) { ++start[i + 1]; });
  for (int i = 0; i < count + border; ++i) start[i + 1] += start[i];
  r.matrix.resizeNonZeros(start[count + border]);
  std::vector<int> next(start, start + count + border);
  for_each_entry([&](int i, int j, double value) {
    const int at = next[std::size_t(i)]++;
    r.matrix.innerIndexPtr()[at] = j;
    r.matrix.valuePtr()[at] = value;
  });
  return r;
}

double largest_entry(const VecX& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0; }

// Back to the system's units: rows over their size are lengths, multipliers over it stresses.
void take_over(const SaddlePointSystem& s, ActiveSetResult&& set, SaddlePointSolution& solution) {
  using Status = SaddlePointSolution::Status;
  solution.active = std::move(set.active);
  solution.steps = std::move(set.steps);
  solution.coarse_steps = set.coarse_steps;
  solution.unsettled = std::move(set.wrong);
  solution.drift = std::move(set.drift);
  solution.driven = set.driven;
  solution.failed_at = set.dependent_row;
  for (ActiveSetStep& step : solution.steps) step.pull *= s.stiffness_scale;
  if (set.status == ActiveSetResult::Status::dependent_row) solution.status = Status::dependent_constraints;
  if (set.status == ActiveSetResult::Status::not_settled) solution.status = Status::not_settled;
  if (set.status == ActiveSetResult::Status::unheld) solution.status = Status::unheld;
}

void measure_residuals(const SaddlePointSystem& s, const std::vector<int>& free, const VecX& Ku,
                       SaddlePointSolution& solution) {
  const VecX pressure = s.B.transpose() * solution.lambda;
  double worst = 0;
  for (const int i : free) worst = std::max(worst, std::abs(s.f(i) - Ku(i) - pressure(i)));
  const double largest = largest_entry(solution.u);
  const double size = std::max(
      {largest_entry(s.f), largest_entry(Ku), largest_entry(pressure), rigid_part * s.stiffness_scale * largest});
  solution.force_residual = size > 0 ? worst / size : 0;
  VecX open = (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
  for (Eigen::Index a = 0; a < open.size(); ++a)
    if (!solution.active[std::size_t(a)]) open(a) = 0;
  solution.constraint_residual = largest > 0 ? largest_entry(open) / largest : 0;
}

}  // namespace

SaddlePointSolution solve_saddle_point(const SaddlePointSystem& s) {
  SaddlePointSolution solution;
  Stopwatch watch;
  const Eigen::Index m = s.B.rows();
  Reduced reduced = reduce(s);
  BorderedCholesky factor(std::move(reduced.matrix), reduced.blocks);
  const std::vector<int>& free = reduced.free;
  if (factor.failed_at() >= 0) {
    solution.status = SaddlePointSolution::Status::not_positive_definite;
    solution.failed_at = free[std::size_t(std::min<std::size_t>(std::size_t(factor.failed_at()), free.size() - 1))];
    return solution;
  }
  solution.factor_bytes = factor.factor_bytes();
  solution.factorise_seconds = watch.lap();

  solution.u = s.value;
  solution.lambda = VecX::Zero(m);
  const std::vector<char> unilateral = s.unilateral.empty() ? std::vector<char>(std::size_t(m), 0) : s.unilateral;
  const auto symmetric = s.K.selfadjointView<Eigen::Lower>();
  VecX Ku = symmetric * solution.u;
  std::optional<MultiplierSystem> multipliers;  // of the active set
  // The first pass solves, as a rule to round-off of the residual itself; a second one refines where it did not.
  for (int pass = 0; pass < 2; ++pass) {
    const VecX Bl = s.B.transpose() * solution.lambda;
    VecX force(Eigen::Index(free.size()));
    for (std::size_t i = 0; i < free.size(); ++i)
      force(Eigen::Index(i)) = (s.f(free[i]) - Ku(free[i]) - Bl(free[i])) / s.stiffness_scale;
    VecX rhs = factor.forward(force);
    rhs.head(m) -= (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
    VecX lambda;
    if (pass == 0) {
      ActiveSetResult set = settle_active_set({factor.border_compliance(), rhs, s.row_scale, unilateral}, s.start);
      lambda = std::move(set.solution);
      multipliers = std::move(set.system);
      take_over(s, std::move(set), solution);
      using Status = SaddlePointSolution::Status;
      if (solution.status == Status::dependent_constraints || solution.status == Status::unheld) return solution;
    } else {
      lambda = multipliers->solve(rhs);
    }
    const VecX u = factor.backward(lambda);
    for (std::size_t i = 0; i < free.size(); ++i) solution.u(free[i]) += u(Eigen::Index(i));
    solution.lambda += s.stiffness_scale * lambda.head(m).cwiseQuotient(s.row_scale);
    Ku = symmetric * solution.u;
    measure_residuals(s, free, Ku, solution);
    if (std::max(solution.force_residual, solution.constraint_residual) < 1e-11) break;
  }
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
