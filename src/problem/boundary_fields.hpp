// The fields of a [[boundary]] entry along its curves: where edges are cut so that they are integrated as they are.
#pragma once

#include "fem/line_cuts.hpp"
#include "problem/boundary_entries.hpp"

namespace mortise {

/// Edges of a curve of the entry, in the order of its sides where it has some.
std::vector<Edge> edges_of(const Mesh& mesh, const NamedBoundary& on);

/// Of all curves of an entry, one after the other, as the mesh has them.
std::vector<Edge> edges_of(const Mesh& mesh, const BoundaryEntry& entry);

/// Those fields of an entry that vary, along its curves.
class BoundaryFields {
 public:
  /// Its arguments must outlive it. Constants cost nothing.
  BoundaryFields(const Mesh& mesh, const std::vector<NamedBoundary>& boundaries, std::vector<const Field*> fields);

  bool any() const { return !fields_.empty(); }
  std::size_t count() const { return fields_.size(); }
  double scale(std::size_t k) const { return scales_[k]; }

  /// Field k along edge e of a curve.
  LineFunction along(std::size_t k, const NamedBoundary& on, int e, const Edge& edge) const;
  /// resolving_cuts for all fields at once.
  std::vector<double> cuts(const NamedBoundary& on, int e, const Edge& edge) const;

 private:
  const Mesh& mesh_;
  std::vector<const Field*> fields_;
  std::vector<FieldRange> ranges_;
  std::vector<double> scales_;
};

/// Values of a prescribed displacement at the nodes of its curves: the field's own, but at the middle node of an edge
/// on which it varies so that the edge's mean is the field's. What the edge then misses works only on what the traction
/// there varies within an edge, wherever spikes and jumps lie. None of a constant.
std::map<int, double> prescribed_values(const Mesh& mesh, const std::vector<NamedBoundary>& boundaries,
                                        const Field& field);

}  // namespace mortise
