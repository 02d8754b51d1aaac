// A bordered matrix taken apart into bodies, and large bodies into halves with a separator between.
#pragma once

#include <array>
#include <atomic>
#include <memory>

#include "solve/bordered_cholesky.hpp"

namespace mortise {

/// The side of a separator's unknowns; those of the halves, and of a body that is whole, are 0 and 1.
inline constexpr char separating = 2;

/// Unknowns that nothing but the border couples with others.
struct SplitBody {
  std::vector<int> unknowns, rows;        ///< of K; columns of those rows of the border that reach it
  bool halved = false;                    ///< a large one
  std::array<std::vector<int>, 3> sides;  ///< its unknowns by side, ascending
  std::array<EliminationOrder, 2> order;  ///< of the halves: places in `sides`
  /// Entries of the separator's rows in columns of the separator and the border, upper triangle.
  Triplets separated;

  int halves() const { return halved ? 2 : 1; }
};

/// Bodies may be cut, and taken when they are cut, by several threads at once.
class Splitting {
 public:
  /// `matrix` and `blocks` as of BorderedCholesky. Bodies of `from` unknowns on are halved, unless they are a small
  /// part of the whole.
  Splitting(SparseMatrix&& matrix, const std::vector<int>& blocks, int from);

  std::vector<std::unique_ptr<SplitBody>> bodies;  ///< the largest first

  /// Orders a body's unknowns (by nested dissection from `dissect` unknowns on), and halves it if it is large.
  void cut(SplitBody& body, int dissect);

  /// The bordered matrix of one side of a body that is cut; the columns of the whole that are its border, those of the
  /// separator first, go to `border`. To be called once for each: the last one frees the whole.
  SparseMatrix take(const SplitBody& body, char side, std::vector<int>& border);

 private:
  void separate(const SplitBody& body, const Dissection& cut);
  bool is_on(const SplitBody& body, char side, int i) const {
    return bodies[body_of_[i]].get() == &body && side_[i] == side;
  }

  SparseMatrix matrix_;
  const std::vector<int>& blocks_;
  int n_;
  std::vector<int> body_of_, place_;  // of each unknown; its place on its side
  std::vector<char> side_;
  std::atomic<int> halves_left_;
};

}  // namespace mortise
