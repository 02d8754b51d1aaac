// The parts that contact alone holds together, each as a system of its own.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// A connected part of K: a body, or bodies with common nodes.
struct Substructure {
  std::vector<int> unknowns;  ///< of the whole system, ascending, both of each node
  std::vector<int> rows;      ///< of the whole system, ascending: those that see it
  std::vector<int> springs;   ///< positions in grounded of the whole system
  SaddlePointSystem system;   ///< on these unknowns and rows; without g and unilateral
};

/// How many there are.
int part_count(const SparseMatrix& K);

/// The free unknowns of a part that its rows see, ascending.
std::vector<int> contact_unknowns(const SaddlePointSystem& part);

/// The parts of a system, in the order of their first unknowns. Each is made when it is asked for: all of them together
/// would take as much memory as the system.
class Substructures {
 public:
  /// Keeps a reference to `system`. Time and memory as its unknowns.
  explicit Substructures(const SaddlePointSystem& system);

  std::size_t size() const { return parts_.size(); }
  /// Time and memory as its entries of K and B.
  Substructure operator[](std::size_t k) const;

 private:
  struct Part {
    std::vector<int> unknowns, springs;
  };
  const SaddlePointSystem& system_;
  std::vector<Part> parts_;
  std::vector<int> local_;  // of each unknown its place in its part
};

/// For each part the first one that is alike, itself maybe: the same stiffness to 1e-11 of its largest entry, unknown
/// by unknown, with the same of them fixed, held by springs and in contact. The rows may differ.
std::vector<int> first_alike(const Substructures& parts);

}  // namespace mortise
