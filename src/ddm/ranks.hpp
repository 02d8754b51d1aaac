// The processes that solve one scene together: what the dual method asks of the others.
#pragma once

#include <memory>
#include <vector>

#include "base/types.hpp"

namespace mortise {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Vectors over the rows of the contact, a column each, each entry with one rank: "own". This class: all of them, in
/// their order.
class DealtRows {
 public:
  virtual ~DealtRows() = default;

  /// The own entries of vectors that every rank has, m.
  virtual MatX own(const MatX& whole) const { return whole; }
  virtual SparseMatrix own(const SparseRows& whole) const { return whole; }
  /// The reverse, on every rank.
  virtual MatX whole(const MatX& own) const { return own; }

  /// Where rows that this rank's parts see stand in the vectors that the next two take and give.
  virtual std::vector<int> places(const std::vector<int>& rows) const { return rows; }
  /// The entries that this rank's parts see, from those who have them.
  virtual MatX seen(const MatX& own) const { return own; }
  /// The reverse: the sum of what all ranks' parts add to each row.
  virtual MatX sum_of_seen(const MatX& seen) const { return seen; }

  /// Of all entries, column by column; the same on each rank.
  virtual VecX dot(const MatX& a, const MatX& b) const { return a.cwiseProduct(b).colwise().sum(); }
  virtual VecX largest(const MatX& own) const {
    VecX found(own.cols());
    for (Eigen::Index k = 0; k < found.size(); ++k) found(k) = largest_entry(own.col(k));
    return found;
  }
};

/// This class: one process alone. All of these are called by all ranks, in the same order.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const { return 0; }
  virtual int count() const { return 1; }

  /// Sums, entry by entry, of what each rank has; on all of them, with the same rounding.
  virtual void sum(double* /*values*/, Eigen::Index /*count*/) const {}
  virtual int largest(int value) const { return value; }
  /// Those of all ranks, in their order.
  virtual Triplets of_all(Triplets own) const { return own; }
  /// Deals out m rows: each to the first rank whose parts see it.
  virtual std::unique_ptr<const DealtRows> deal(Eigen::Index /*rows*/, const std::vector<int>& /*seen*/) const {
    return std::make_unique<DealtRows>();
  }

  /// The process ends with this exit status: waits for the others, and tells what a rank fails at on its own. An error
  /// that all ranks meet is told by the first. Returns the exit status.
  virtual int end(int status) { return status; }
};

/// Those of this process: it alone before join_ranks, and if mpirun did not start it or mortise was built without
/// MORTISE_MPI.
const Ranks& ranks();
/// Called once, first of all; ranks but the first write nothing to the terminal from here on.
Ranks& join_ranks();

}  // namespace mortise
