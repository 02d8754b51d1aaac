#include "ddm/substructures.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/each_once.hpp"
#include "base/union_find.hpp"

namespace mortise {
namespace {

// The part of each node, numbered in the order of their first nodes.
std::vector<int> parts_of_nodes(const SparseMatrix& K) {
  const int nodes = int(K.cols()) / 2;
  UnionFind connected(nodes);
  for (int j = 0; j < K.cols(); ++j)
    for (SparseMatrix::InnerIterator it(K, j); it; ++it) connected.join(j / 2, int(it.row()) / 2);
  std::vector<int> part(nodes);
  int count = 0;
  for (int i = 0; i < nodes; ++i) part[i] = connected.find(i) == i ? count++ : part[connected.find(i)];
  return part;
}

// The columns of `matrix` that `unknowns` names, rows renumbered.
template <typename Row>
SparseMatrix columns_of(const SparseMatrix& matrix, const std::vector<int>& unknowns, int rows, Row row) {
  SparseMatrix part(rows, Eigen::Index(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    part.outerIndexPtr()[j + 1] =
        part.outerIndexPtr()[j] + int(matrix.outerIndexPtr()[unknowns[j] + 1] - matrix.outerIndexPtr()[unknowns[j]]);
  part.resizeNonZeros(part.outerIndexPtr()[unknowns.size()]);
  Eigen::Index at = 0;
  for (const int unknown : unknowns)
    for (SparseMatrix::InnerIterator it(matrix, unknown); it; ++it, ++at) {
      part.innerIndexPtr()[at] = row(int(it.row()));
      part.valuePtr()[at] = it.value();
    }
  return part;
}

constexpr double alike_stiffness = 1e-11;  // copies' nodes are off by the round-off of their coordinates

bool same_stiffness(const SparseMatrix& one, const SparseMatrix& other) {
  const Eigen::Index count = one.nonZeros();
  if (one.cols() != other.cols() || count != other.nonZeros() ||
      !std::equal(one.outerIndexPtr(), one.outerIndexPtr() + one.cols(), other.outerIndexPtr()) ||
      !std::equal(one.innerIndexPtr(), one.innerIndexPtr() + count, other.innerIndexPtr()))
    return false;
  const Eigen::Map<const VecX> a(one.valuePtr(), count), b(other.valuePtr(), count);
  return (a - b).cwiseAbs().maxCoeff() <= alike_stiffness * largest_entry(a);
}

}  // namespace

std::vector<int> contact_unknowns(const SaddlePointSystem& part) {
  std::vector<int> seen;
  for (int i = 0; i < part.B.cols(); ++i) {
    double size = 0;
    for (SparseMatrix::InnerIterator it(part.B, i); it; ++it) size += std::abs(it.value());
    if (size > 0 && !part.constraints.fixed[i]) seen.push_back(i);
  }
  return seen;
}

std::vector<int> first_alike(const Substructures& parts) {
  // By what must be equal, then by the trace.
  std::map<std::vector<int>, std::multimap<double, int>> known;
  std::map<int, SparseMatrix> stiffness;  // of the first ones
  std::vector<int> first(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    SaddlePointSystem s = parts[k].system;
    std::vector<int> key = contact_unknowns(s);
    key.push_back(-1);
    for (std::size_t i = 0; i < s.constraints.fixed.size(); ++i)
      if (s.constraints.fixed[i]) key.push_back(int(i));
    key.push_back(-1);
    key.insert(key.end(), s.grounded.begin(), s.grounded.end());
    std::multimap<double, int>& by_trace = known[key];
    const double trace = s.K.diagonal().sum(), margin = double(s.K.cols()) * alike_stiffness * trace;
    first[k] = int(k);
    for (auto it = by_trace.lower_bound(trace - margin); it != by_trace.end() && it->first <= trace + margin; ++it)
      if (same_stiffness(s.K, stiffness.at(it->second))) {
        first[k] = it->second;
        break;
      }
    if (first[k] != int(k)) continue;
    by_trace.emplace(trace, int(k));
    stiffness.emplace(int(k), std::move(s.K));
  }
  return first;
}

int part_count(const SparseMatrix& K) {
  const std::vector<int> part = parts_of_nodes(K);
  return part.empty() ? 0 : *std::ranges::max_element(part) + 1;
}

Substructures::Substructures(const SaddlePointSystem& s) : system_(s), local_(s.K.cols()) {
  const std::vector<int> part = parts_of_nodes(s.K);
  parts_.resize(part.empty() ? 0 : *std::ranges::max_element(part) + 1);
  for (int i = 0; i < int(local_.size()); ++i) {
    std::vector<int>& unknowns = parts_[part[i / 2]].unknowns;
    local_[i] = int(unknowns.size());
    unknowns.push_back(i);
  }
  for (std::size_t k = 0; k < s.grounded.size(); ++k) parts_[part[s.grounded[k] / 2]].springs.push_back(int(k));
}

Substructure Substructures::operator[](std::size_t k) const {
  const SaddlePointSystem& s = system_;
  Substructure own{.unknowns = parts_[k].unknowns, .rows = {}, .springs = parts_[k].springs, .system = {}};
  for (const int unknown : own.unknowns)
    for (SparseMatrix::InnerIterator it(s.B, unknown); it; ++it) own.rows.push_back(int(it.row()));
  keep_each_once(own.rows);
  const auto local = [&](int unknown) { return local_[unknown]; };
  const auto local_row = [&](int row) { return int(std::ranges::lower_bound(own.rows, row) - own.rows.begin()); };

  SaddlePointSystem& system = own.system;
  system.K = columns_of(s.K, own.unknowns, int(own.unknowns.size()), local);
  system.B = columns_of(s.B, own.unknowns, int(own.rows.size()), local_row);
  system.f = s.f(own.unknowns);
  system.row_scale = s.row_scale(own.rows);
  system.stiffness_scale = s.stiffness_scale;
  system.constraints.value = s.constraints.value(own.unknowns);
  for (const int unknown : own.unknowns) system.constraints.fixed.push_back(s.constraints.fixed[unknown]);
  for (const int spring : own.springs) system.grounded.push_back(local_[s.grounded[spring]]);
  return own;
}

}  // namespace mortise
