#include "solve/split_cholesky.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "base/parallel.hpp"
#include "base/union_find.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// Unknowns of K that hang together.
std::vector<std::vector<int>> coupled_unknowns(const SparseMatrix& upper, const std::vector<int>& blocks) {
  UnionFind coupled(blocks.size());
  for (int j = 0; j < int(blocks.size()); ++j) {
    if (j > 0 && blocks[j] == blocks[j - 1]) coupled.join(j, j - 1);
    for (SparseMatrix::InnerIterator it(upper, j); it; ++it) coupled.join(int(it.row()), j);
  }
  return coupled.sets();
}

// The bordered matrices of parts of the unknowns, each with those rows of the border that reach it, which go to `rows`.
std::vector<SparseMatrix> split(const SparseMatrix& upper, const std::vector<std::vector<int>>& parts,
                                std::vector<std::vector<int>>& rows) {
  const int n = int(std::accumulate(parts.begin(), parts.end(), std::size_t(0),
                                    [](std::size_t sum, const auto& part) { return sum + part.size(); }));
  std::vector<int> part_of(n), number(n);
  for (int p = 0; p < int(parts.size()); ++p)
    for (int k = 0; k < int(parts[p].size()); ++k) {
      part_of[parts[p][k]] = p;
      number[parts[p][k]] = k;
    }
  rows.assign(parts.size(), {});
  std::vector<Eigen::Index> entries(parts.size());
  for (int j = 0; j < int(upper.cols()); ++j)
    for (SparseMatrix::InnerIterator it(upper, j); it && it.row() < n; ++it) {
      const int p = part_of[it.row()];
      ++entries[p];
      if (j >= n && (rows[p].empty() || rows[p].back() != j - n)) rows[p].push_back(j - n);
    }
  std::vector<SparseMatrix> matrices;
  matrices.reserve(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto size = Eigen::Index(parts[p].size() + rows[p].size());
    SparseMatrix& own = matrices.emplace_back(size, size);
    own.reserve(entries[p] + Eigen::Index(rows[p].size()));
    for (int c = 0; c < int(parts[p].size()); ++c) {
      own.startVec(c);
      for (SparseMatrix::InnerIterator it(upper, parts[p][c]); it; ++it)
        own.insertBack(number[it.row()], c) = it.value();
    }
  }
  std::vector<int> next(parts.size());  // of its border rows
  for (int j = n; j < int(upper.cols()); ++j) {
    std::vector<std::size_t> reached;
    for (SparseMatrix::InnerIterator it(upper, j); it && it.row() < n; ++it) {
      const std::size_t p = part_of[it.row()];
      const Eigen::Index c = Eigen::Index(parts[p].size()) + next[p];
      if (std::ranges::find(reached, p) == reached.end()) {
        reached.push_back(p);
        matrices[p].startVec(c);
      }
      matrices[p].insertBack(number[it.row()], c) = it.value();
    }
    for (const std::size_t p : reached) {
      const Eigen::Index c = Eigen::Index(parts[p].size()) + next[p]++;
      matrices[p].insertBack(c, c) = border_beta;
    }
  }
  for (SparseMatrix& own : matrices) own.finalize();
  return matrices;
}

}  // namespace

template <typename Work>
void SplitCholesky::for_each_part(Work work) const {
  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) { work(parts_[k]); });
}

SplitCholesky::SplitCholesky(SparseMatrix&& matrix, const std::vector<int>& blocks, int from)
    : unknowns_(Eigen::Index(blocks.size())), rows_(matrix.cols() - unknowns_) {
  std::vector<SparseMatrix> matrices;
  std::vector<std::vector<int>> sets, rows(1);
  if (unknowns_ >= from) sets = coupled_unknowns(matrix, blocks);
  std::ranges::stable_sort(sets, std::greater(), &std::vector<int>::size);  // the longest work first
  if (sets.size() < 2) {
    sets.assign(1, std::vector<int>(unknowns_));
    rows[0].resize(rows_);
    std::iota(sets[0].begin(), sets[0].end(), 0);
    std::iota(rows[0].begin(), rows[0].end(), 0);
    matrices.emplace_back().swap(matrix);
  } else {
    matrices = split(matrix, sets, rows);
    SparseMatrix().swap(matrix);
  }
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const Eigen::Index first = k > 0 ? parts_.back().first + parts_.back().size() : 0;
    parts_.push_back({std::move(sets[k]), std::move(rows[k]), first, nullptr});
  }

  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) {
    std::vector<int> own;
    for (const int i : parts_[k].unknowns)
      own.push_back(own.empty() ? 0 : own.back() + (blocks[i] != blocks[parts_[k].unknowns[own.size() - 1]]));
    parts_[k].factor = std::make_unique<BorderedCholesky>(std::move(matrices[k]), own);
  });
  if (parts_.size() == 1) {
    compliance_ = parts_[0].factor->take_border_compliance();
    return;
  }
  compliance_ = MatX::Zero(rows_, rows_);
  for (Part& part : parts_) compliance_(part.rows, part.rows) += part.factor->take_border_compliance();
}

int SplitCholesky::failed_at() const {
  for (const Part& part : parts_)
    if (const int at = part.factor->failed_at(); at >= 0)
      return at < int(part.unknowns.size()) ? part.unknowns[at] : int(unknowns_) + part.rows[at - part.unknowns.size()];
  return -1;
}

Eigen::Index SplitCholesky::size() const { return parts_.back().first + parts_.back().size(); }

VecX SplitCholesky::forward(const VecX& f) const {
  VecX y(size());
  for_each_part([&](const Part& part) { y.segment(part.first, part.size()) = part.factor->forward(f(part.unknowns)); });
  return y;
}

VecX SplitCholesky::at_border(const VecX& y) const {
  VecX response = VecX::Zero(rows_);
  for (const Part& part : parts_) response(part.rows) += part.factor->at_border(y.segment(part.first, part.size()));
  return response;
}

MatX SplitCholesky::backward(const MatX& y, const MatX& lambda) const {
  MatX u(unknowns_, y.cols());
  for_each_part([&](const Part& part) {
    u(part.unknowns, Eigen::all) =
        part.factor->backward(y.middleRows(part.first, part.size()), lambda(part.rows, Eigen::all));
  });
  return u;
}

}  // namespace mortise
