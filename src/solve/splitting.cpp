#include "solve/splitting.hpp"

#include <algorithm>
#include <functional>

#include "base/union_find.hpp"

namespace mortise {
namespace {

// Unknowns of K that hang together, the most first.
std::vector<std::vector<int>> coupled_unknowns(const SparseMatrix& upper, const std::vector<int>& blocks) {
  UnionFind coupled(blocks.size());
  for (int j = 0; j < int(blocks.size()); ++j) {
    if (j > 0 && blocks[j] == blocks[j - 1]) coupled.join(j, j - 1);
    for (SparseMatrix::InnerIterator it(upper, j); it; ++it) coupled.join(int(it.row()), j);
  }
  std::vector<std::vector<int>> sets = coupled.sets();
  std::ranges::stable_sort(sets, std::greater(), &std::vector<int>::size);
  return sets;
}

}  // namespace

Splitting::Splitting(SparseMatrix&& matrix, const std::vector<int>& blocks, int from)
    : matrix_(std::move(matrix)), blocks_(blocks), n_(int(blocks.size())), body_of_(n_), place_(n_), side_(n_) {
  // Halves are to keep cores busy: where no body is much of the whole, the bodies do.
  constexpr int enough_bodies = 8;
  for (std::vector<int>& unknowns : coupled_unknowns(matrix_, blocks)) {
    for (const int i : unknowns) body_of_[i] = int(bodies.size());
    const int size = int(unknowns.size());
    bodies.push_back(std::make_unique<SplitBody>());
    bodies.back()->unknowns = std::move(unknowns);
    bodies.back()->halved = size >= from && size > n_ / enough_bodies;
  }
  for (int r = n_; r < int(matrix_.cols()); ++r)
    for (SparseMatrix::InnerIterator it(matrix_, r); it && it.row() < n_; ++it)
      if (std::vector<int>& rows = bodies[body_of_[it.row()]]->rows; rows.empty() || rows.back() != r)
        rows.push_back(r);
  halves_left_ = 0;
  for (const auto& body : bodies) halves_left_ += body->halves();
}

void Splitting::separate(const SplitBody& body, const Dissection& cut) {
  for (int k = 0; k < int(cut.order.size()); ++k)
    side_[cut.order[k]] = k < cut.first ? 0 : k < cut.first + cut.second ? 1 : separating;
  // The order knows what the first unknown of a node is coupled to; others may be coupled to more.
  for (const int j : body.unknowns)
    for (SparseMatrix::InnerIterator it(matrix_, j); it; ++it)
      if (side_[it.row()] + side_[j] == 1) side_[j] = separating;
}

void Splitting::cut(SplitBody& body, int dissect) {
  const Dissection cut = dissection(matrix_, blocks_, body.unknowns, dissect);
  if (body.halved) separate(body, cut);
  std::array<int, 3> count{};
  for (const int i : body.unknowns) {
    place_[i] = count[side_[i]]++;
    body.sides[side_[i]].push_back(i);
  }
  for (const int i : cut.order)
    if (side_[i] != separating) body.order[side_[i]].unknowns.push_back(place_[i]);
  for (const auto* columns : {&body.sides[separating], &body.rows})
    for (const int j : *columns)
      for (SparseMatrix::InnerIterator it(matrix_, j); it && it.row() < n_; ++it)
        if (is_on(body, separating, int(it.row()))) body.separated.emplace_back(int(it.row()), j, it.value());
}

SparseMatrix Splitting::take(const SplitBody& body, char side, std::vector<int>& border) {
  const std::vector<int>&own = body.sides[side], &separator = body.sides[separating];
  border = separator;
  for (const int r : body.rows)
    for (SparseMatrix::InnerIterator it(matrix_, r); it && it.row() < n_; ++it)
      if (is_on(body, side, int(it.row()))) {
        border.push_back(r);
        break;
      }
  const int size = int(own.size()), all = size + int(border.size());
  std::vector<int> columns(size + separator.size());
  std::ranges::merge(own, separator, columns.begin());
  // An entry (i, j) of the upper triangle goes to column j, in which they come in order.
  const auto for_each_entry = [&](auto visit) {
    for (const int j : columns)
      for (SparseMatrix::InnerIterator it(matrix_, j); it; ++it) {
        const int i = int(it.row());
        if (side_[i] == side && side_[j] == side) visit(place_[i], place_[j], it.value());
        if (side_[i] == side && side_[j] == separating) visit(place_[i], size + place_[j], it.value());
        if (side_[i] == separating && side_[j] == side) visit(place_[j], size + place_[i], it.value());
      }
    for (int j = size + int(separator.size()); j < all; ++j)
      for (SparseMatrix::InnerIterator it(matrix_, border[j - size]); it && it.row() < n_; ++it)
        if (is_on(body, side, int(it.row()))) visit(place_[it.row()], j, it.value());
    for (int j = size; j < all; ++j) visit(j, j, border_beta);
  };
  SparseMatrix part(all, all);
  int* start = part.outerIndexPtr();
  for_each_entry([&](int, int j, double) { ++start[j + 1]; });
  for (int j = 0; j < all; ++j) start[j + 1] += start[j];
  part.resizeNonZeros(start[all]);
  std::vector<int> next(start, start + all);
  for_each_entry([&](int i, int j, double value) {
    const int at = next[j]++;
    part.innerIndexPtr()[at] = i;
    part.valuePtr()[at] = value;
  });
  if (--halves_left_ == 0) matrix_ = SparseMatrix();
  return part;
}

}  // namespace mortise
