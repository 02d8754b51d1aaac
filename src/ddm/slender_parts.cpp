#include "ddm/slender_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "ddm/solve_together.hpp"

namespace mortise {
namespace {

// Of random laminates and leaf springs 3 and 12 take as many steps; with 24 they take ten times as many, or end worse.
constexpr double slender_from = 6;
constexpr double soft_spring = 1e-8;       // at free motions, for their pivots
constexpr double least_compliance = 1e-3;  // of a row's own, where nothing but slender parts touch

// Numbers the entries that are not negative; how many.
int number(std::vector<int>& entries) {
  int count = 0;
  for (int& entry : entries)
    if (entry >= 0) entry = count++;
  return count;
}

}  // namespace

PartKind kind_of(const Substructure& part, const std::vector<double>& slenderness) {
  const auto bends = [&](int unknown) {
    const std::size_t node = unknown / 2;
    return node < slenderness.size() && slenderness[node] > slender_from;
  };
  if (part.rows.empty() || std::ranges::none_of(part.unknowns, bends)) return PartKind::compact;
  // Operations to factorise the rows' compliance, or the part (nested dissection in the plane: George 1973).
  const double rows = double(part.rows.size()), unknowns = double(part.unknowns.size()), band = 4 * std::log2(unknowns);
  return rows * rows * rows / 3 <= unknowns * band * band ? PartKind::slender : PartKind::slender_with_many_rows;
}

void add_stiffness(const Substructure& part, Triplets& entries) {
  const SaddlePointSystem& s = part.system;
  for (int j = 0; j < s.K.cols(); ++j) {
    if (s.constraints.fixed[j]) continue;
    for (SparseMatrix::InnerIterator it(s.K, j); it; ++it)
      if (!s.constraints.fixed[it.row()])
        entries.emplace_back(part.unknowns[it.row()], part.unknowns[j], it.value() / s.stiffness_scale);
  }
}

SlenderParts slender_parts(std::vector<int> rows, Triplets stiffness, const SaddlePointSystem& s) {
  SlenderParts parts;
  if (rows.empty()) return parts;
  parts.rows = std::move(rows);
  parts.place.assign(s.B.rows(), -1);
  for (std::size_t a = 0; a < parts.rows.size(); ++a) parts.place[parts.rows[a]] = int(a);

  std::vector<int> unknown(s.K.cols(), -1);
  for (const auto& entry : stiffness) unknown[entry.row()] = 0;
  const int unknowns = number(unknown);
  for (std::size_t k = 0; k < s.grounded.size(); ++k)
    if (unknown[s.grounded[k]] >= 0) parts.springs.emplace_back(unknown[s.grounded[k]], int(k));
  for (auto& entry : stiffness) entry = {unknown[entry.row()], unknown[entry.col()], entry.value()};
  parts.K = filled(unknowns, unknowns, stiffness);
  Triplets coupling;
  for (int i = 0; i < s.B.cols(); ++i)
    if (unknown[i] >= 0)
      for (SparseMatrix::InnerIterator it(s.B, i); it; ++it)
        coupling.emplace_back(parts.place[it.row()], unknown[i], it.value() / s.row_scale(it.row()));
  parts.B = filled(parts.rows.size(), unknowns, coupling);
  return parts;
}

void TouchingParts::add(const SlenderParts& parts, const std::vector<int>& of_rows, const MatX& C,
                        const MatX& of_motions, const std::vector<int>& springs) {
  const auto place = [&](std::size_t a) { return parts.place[of_rows[a]]; };
  bool all = true;
  for (std::size_t a = 0; a < of_rows.size(); ++a) all = all && place(a) >= 0;
  for (std::size_t b = 0; b < of_rows.size(); ++b) {
    if (place(b) < 0) continue;
    for (std::size_t a = b; a < of_rows.size(); ++a)
      if (place(a) >= 0) D.emplace_back(place(a), place(b), C(a, b));
    for (std::size_t j = 0; all && j < springs.size(); ++j) H.emplace_back(place(b), springs[j], of_motions(b, j));
  }
}

void set_touching(SlenderParts& parts, TouchingParts touching, const VecX& local) {
  const auto rows = Eigen::Index(parts.rows.size());
  for (int a = 0; a < rows; ++a) touching.D.emplace_back(a, a, least_compliance * local(parts.rows[a]));
  parts.D = filled(rows, rows, touching.D);

  std::map<int, int> column;  // of a spring
  for (auto& entry : touching.H)
    entry = {entry.row(), column.try_emplace(entry.col(), int(column.size())).first->second, entry.value()};
  parts.springs_of_H.resize(column.size());
  for (const auto& [spring, of] : column) parts.springs_of_H[of] = spring;
  parts.H = filled(rows, column.size(), touching.H);
}

SlenderInverse::SlenderInverse(const SlenderParts& parts, const std::vector<char>& closed)
    : rows_(parts.rows), closed_(parts.rows.size()), unknowns_(parts.K.cols() + parts.H.cols()) {
  for (std::size_t a = 0; a < rows_.size(); ++a) closed_(a) = closed[rows_[a]] ? 1 : 0;
  Triplets all;
  const auto add = [&](const SparseMatrix& A, Eigen::Index row, Eigen::Index column, auto value) {
    for_each_entry(
        A, [&](int i, int j, double entry) { all.emplace_back(int(row) + i, int(column) + j, value(i, j, entry)); });
  };
  add(parts.K, 0, 0, [](Eigen::Index, Eigen::Index, double entry) { return entry; });
  add(parts.B, unknowns_, 0, [&](Eigen::Index a, Eigen::Index, double entry) { return closed_(a) * entry; });
  const auto hold = [&](Eigen::Index unknown) { all.emplace_back(int(unknown), int(unknown), soft_spring); };
  for (const auto& [unknown, spring] : parts.springs) hold(unknown);
  for (Eigen::Index k = 0; k < parts.H.cols(); ++k) hold(parts.K.cols() + k);
  add(parts.H, unknowns_, parts.K.cols(),
      [&](Eigen::Index a, Eigen::Index, double entry) { return -closed_(a) * entry; });
  add(parts.D, unknowns_, unknowns_,
      [&](Eigen::Index a, Eigen::Index b, double entry) { return a == b ? -entry : -closed_(a) * closed_(b) * entry; });
  factor_.compute(filled(unknowns_ + closed_.size(), unknowns_ + closed_.size(), all));
}

MatX SlenderInverse::multiply(const MatX& gaps) const {
  MatX right = MatX::Zero(unknowns_ + closed_.size(), gaps.cols()), lambda = MatX::Zero(gaps.rows(), gaps.cols());
  right.bottomRows(closed_.size()) = -(closed_.asDiagonal() * MatX(gaps(rows_, Eigen::all)));
  lambda(rows_, Eigen::all) = closed_.asDiagonal() * solve_together(factor_, right).bottomRows(closed_.size());
  return lambda;
}

}  // namespace mortise
