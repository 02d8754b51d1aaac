#include "ddm/substructures.hpp"

#include <algorithm>
#include <numeric>

namespace mortise {
namespace {

// The part of each node, numbered in the order of their first nodes.
std::vector<int> parts_of_nodes(const SparseMatrix& K) {
  const int nodes = int(K.cols()) / 2;
  std::vector<int> parent(nodes);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (int j = 0; j < K.cols(); ++j)
    for (SparseMatrix::InnerIterator it(K, j); it; ++it) {
      const int a = root(j / 2), b = root(int(it.row()) / 2);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<int> part(nodes);
  int count = 0;
  for (int i = 0; i < nodes; ++i) part[i] = root(i) == i ? count++ : part[root(i)];
  return part;
}

// The columns of `matrix` that `unknowns` names, rows renumbered.
SparseMatrix columns_of(const SparseMatrix& matrix, const std::vector<int>& unknowns, const std::vector<int>& row,
                        int rows) {
  SparseMatrix part(rows, Eigen::Index(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    part.outerIndexPtr()[j + 1] =
        part.outerIndexPtr()[j] + int(matrix.outerIndexPtr()[unknowns[j] + 1] - matrix.outerIndexPtr()[unknowns[j]]);
  part.resizeNonZeros(part.outerIndexPtr()[unknowns.size()]);
  Eigen::Index at = 0;
  for (const int unknown : unknowns)
    for (SparseMatrix::InnerIterator it(matrix, unknown); it; ++it, ++at) {
      part.innerIndexPtr()[at] = row[it.row()];
      part.valuePtr()[at] = it.value();
    }
  return part;
}

// Leaves the parts whose middle unknown, with all counted through, is in the block of this rank.
void keep_block(std::vector<Substructure>& parts, Eigen::Index unknowns, int rank, int ranks) {
  Eigen::Index before = 0;
  std::erase_if(parts, [&](const Substructure& part) {
    const Eigen::Index size = part.unknowns.size(), middle = before + size / 2;
    before += size;
    return middle * ranks / unknowns != rank;
  });
}

}  // namespace

int part_count(const SparseMatrix& K) {
  const std::vector<int> part = parts_of_nodes(K);
  return part.empty() ? 0 : *std::ranges::max_element(part) + 1;
}

std::vector<Substructure> substructures(const SaddlePointSystem& s, int rank, int ranks) {
  const int n = int(s.K.cols());
  const std::vector<int> part = parts_of_nodes(s.K);
  std::vector<Substructure> all(part.empty() ? 0 : *std::ranges::max_element(part) + 1);
  std::vector<int> local(n), local_row(s.B.rows(), -1);
  for (int i = 0; i < n; ++i) {
    local[i] = int(all[part[i / 2]].unknowns.size());
    all[part[i / 2]].unknowns.push_back(i);
  }
  for (std::size_t k = 0; k < s.grounded.size(); ++k) {
    Substructure& own = all[part[s.grounded[k] / 2]];
    own.springs.push_back(int(k));
    own.system.grounded.push_back(local[s.grounded[k]]);
  }
  keep_block(all, n, rank, ranks);
  for (Substructure& own : all) {
    for (const int unknown : own.unknowns)
      for (SparseMatrix::InnerIterator it(s.B, unknown); it; ++it) own.rows.push_back(int(it.row()));
    std::ranges::sort(own.rows);
    own.rows.erase(std::unique(own.rows.begin(), own.rows.end()), own.rows.end());
    for (std::size_t a = 0; a < own.rows.size(); ++a) local_row[own.rows[a]] = int(a);

    SaddlePointSystem& system = own.system;
    system.K = columns_of(s.K, own.unknowns, local, int(own.unknowns.size()));
    system.B = columns_of(s.B, own.unknowns, local_row, int(own.rows.size()));
    system.f = s.f(own.unknowns);
    system.row_scale = s.row_scale(own.rows);
    system.stiffness_scale = s.stiffness_scale;
    system.constraints.value = s.constraints.value(own.unknowns);
    for (const int unknown : own.unknowns) system.constraints.fixed.push_back(s.constraints.fixed[unknown]);
  }
  return all;
}

}  // namespace mortise
