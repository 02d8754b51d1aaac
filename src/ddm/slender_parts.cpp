#include "ddm/slender_parts.hpp"

#include <algorithm>

namespace mortise {
namespace {

constexpr double slender = 6;              // slenderness
constexpr int few_rows = 100;              // conjugate gradients find so many by themselves
constexpr double soft_spring = 1e-3;       // of the springs that are taken out exactly
constexpr double least_compliance = 1e-3;  // of a row's own, where nothing but slender parts touch

// Numbers the entries that are not negative; how many.
int number(std::vector<int>& entries) {
  int count = 0;
  for (int& entry : entries)
    if (entry >= 0) entry = count++;
  return count;
}

}  // namespace

bool is_slender(const Substructure& part) {
  return part.rows.size() > few_rows && slenderness(part.system.K) > slender;
}

void add_stiffness(const Substructure& part, Triplets& entries) {
  const SaddlePointSystem& s = part.system;
  for (int j = 0; j < s.K.cols(); ++j) {
    if (s.constraints.fixed[j]) continue;
    for (SparseMatrix::InnerIterator it(s.K, j); it; ++it)
      if (!s.constraints.fixed[it.row()])
        entries.emplace_back(part.unknowns[it.row()], part.unknowns[j], it.value() / s.stiffness_scale);
  }
  for (const int i : s.grounded) entries.emplace_back(part.unknowns[i], part.unknowns[i], soft_spring);
}

SlenderParts slender_parts(Triplets stiffness, const SaddlePointSystem& s) {
  stiffness = ranks().of_all(std::move(stiffness));
  SlenderParts parts;
  if (stiffness.empty()) return parts;
  std::vector<int> unknown(s.K.cols(), -1);
  for (const auto& entry : stiffness) unknown[entry.row()] = 0;
  const int unknowns = number(unknown);
  parts.place.assign(s.B.rows(), -1);
  for (int i = 0; i < s.B.cols(); ++i)
    if (unknown[i] >= 0)
      for (SparseMatrix::InnerIterator it(s.B, i); it; ++it) parts.place[it.row()] = 0;
  parts.rows.resize(number(parts.place));
  for (std::size_t a = 0; a < parts.place.size(); ++a)
    if (parts.place[a] >= 0) parts.rows[parts.place[a]] = int(a);

  for (auto& entry : stiffness) entry = {unknown[entry.row()], unknown[entry.col()], entry.value()};
  parts.K.resize(unknowns, unknowns);
  parts.K.setFromTriplets(stiffness.begin(), stiffness.end());
  Triplets coupling;
  for (int i = 0; i < s.B.cols(); ++i)
    if (unknown[i] >= 0)
      for (SparseMatrix::InnerIterator it(s.B, i); it; ++it)
        coupling.emplace_back(parts.place[it.row()], unknown[i], it.value() / s.row_scale(it.row()));
  parts.B.resize(Eigen::Index(parts.rows.size()), unknowns);
  parts.B.setFromTriplets(coupling.begin(), coupling.end());
  return parts;
}

void add_compliance(const SlenderParts& parts, const std::vector<int>& rows, const MatX& C, const MatX& H,
                    Triplets& entries) {
  for (std::size_t b = 0; b < rows.size(); ++b) {
    if (parts.place[rows[b]] < 0) continue;
    for (std::size_t a = b; a < rows.size(); ++a)
      if (parts.place[rows[a]] >= 0)
        entries.emplace_back(parts.place[rows[a]], parts.place[rows[b]],
                             C(a, b) + H.row(a).dot(H.row(b)) / soft_spring);
  }
}

void set_compliance(SlenderParts& parts, Triplets entries, const VecX& local) {
  entries = ranks().of_all(std::move(entries));
  for (std::size_t a = 0; a < parts.rows.size(); ++a)
    entries.emplace_back(int(a), int(a), least_compliance * local(parts.rows[a]));
  parts.D.resize(Eigen::Index(parts.rows.size()), Eigen::Index(parts.rows.size()));
  parts.D.setFromTriplets(entries.begin(), entries.end());
}

SlenderInverse::SlenderInverse(const SlenderParts& parts, const std::vector<char>& closed)
    : rows_(parts.rows), closed_(parts.rows.size()), unknowns_(parts.K.cols()) {
  for (std::size_t a = 0; a < rows_.size(); ++a) closed_(a) = closed[rows_[a]] ? 1 : 0;
  Triplets all;
  const auto add = [&](const SparseMatrix& A, Eigen::Index row, Eigen::Index column, auto value) {
    for (int j = 0; j < A.cols(); ++j)
      for (SparseMatrix::InnerIterator it(A, j); it; ++it)
        all.emplace_back(int(row + it.row()), int(column + j), value(it.row(), j, it.value()));
  };
  add(parts.K, 0, 0, [](Eigen::Index, Eigen::Index, double entry) { return entry; });
  add(parts.B, unknowns_, 0, [&](Eigen::Index a, Eigen::Index, double entry) { return closed_(a) * entry; });
  add(parts.D, unknowns_, unknowns_,
      [&](Eigen::Index a, Eigen::Index b, double entry) { return a == b ? -entry : -closed_(a) * closed_(b) * entry; });
  SparseMatrix matrix(unknowns_ + closed_.size(), unknowns_ + closed_.size());
  matrix.setFromTriplets(all.begin(), all.end());
  factor_.compute(matrix);
}

VecX SlenderInverse::multiply(const VecX& gap) const {
  const VecX found = factor_.solve(stacked(VecX::Zero(unknowns_), -closed_.cwiseProduct(VecX(gap(rows_)))));
  VecX lambda = VecX::Zero(gap.size());
  lambda(rows_) = closed_.cwiseProduct(found.tail(closed_.size()));
  return lambda;
}

}  // namespace mortise
