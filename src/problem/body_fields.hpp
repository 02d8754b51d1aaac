// Fields over bodies: where cells are cut so that they are integrated as they are.
#pragma once

#include "fem/cell_cuts.hpp"
#include "model/body_specs.hpp"

namespace mortise {

/// The fields that vary of each body. Its arguments must outlive it.
class BodyFields {
 public:
  explicit BodyFields(const Mesh& mesh) : mesh_(mesh), fields_(mesh.bodies.size()) {}

  /// Adds a field on a body; a constant costs nothing.
  void add(int body, const Field& field);
  /// After all are added: by how much each varies.
  void find_scales();

  bool any() const;
  bool any(int body) const { return !fields_[body].empty(); }
  const std::vector<ScaledField>& of(int body) const { return fields_[body]; }

  /// resolving_pieces of a cell for the fields of its body.
  std::vector<CellPiece> pieces(const Cell& cell) const;
  /// The rule on them, or on the whole cell where there are none; without points where no field of its body varies.
  CellRule rule(const Cell& cell) const;

 private:
  const Mesh& mesh_;
  std::vector<std::vector<ScaledField>> fields_;  // by body
};

/// Adds the fields of an initial strain.
void add_strain(const InitialStrainSpec& spec, int body, BodyFields& fields);

}  // namespace mortise
