#include "problem/body_fields.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace mortise {
namespace {

// The box of a cell's corners.
PlaceRange box_of(const Mesh& mesh, const Cell& cell) {
  Eigen::AlignedBox2d box;
  for (int a = 0; a < corner_count(cell.kind); ++a) box.extend(mesh.nodes.row(cell.nodes[a]).transpose());
  return {{box.min().x(), box.max().x()}, {box.min().y(), box.max().y()}, {}};
}

}  // namespace

void BodyFields::add(int body, const Field& field) {
  if (!field.is_constant()) fields_[body].push_back({&field, FieldRange(field), 0});
}

bool BodyFields::any() const {
  return std::ranges::any_of(fields_, [](const auto& of_body) { return !of_body.empty(); });
}

void BodyFields::find_scales() {
  if (!any()) return;
  struct Seen {
    std::optional<Interval> values, range;
  };
  std::vector<std::vector<Seen>> seen;
  for (const auto& of_body : fields_) seen.emplace_back(of_body.size());
  for (const Cell& cell : mesh_.cells)
    for (std::size_t k = 0; k < fields_[cell.body].size(); ++k) {
      const auto& [field, range_of, unknown] = fields_[cell.body][k];
      Seen& so_far = seen[cell.body][k];
      const double value = (*field)(centre_of(mesh_.nodes, cell));
      so_far.values = so_far.values ? hull(*so_far.values, {value, value}) : Interval{value, value};
      if (!range_of.known()) continue;
      const Interval range = range_of(box_of(mesh_, cell));
      if (std::isfinite(range.magnitude())) so_far.range = so_far.range ? hull(*so_far.range, range) : range;
    }
  for (std::size_t b = 0; b < fields_.size(); ++b)
    for (std::size_t k = 0; k < fields_[b].size(); ++k) {
      const auto& [values, range] = seen[b][k];
      fields_[b][k].scale = scale_of(values.value_or(Interval{}), range);
    }
}

void add_strain(const InitialStrainSpec& spec, int body, BodyFields& fields) {
  if (spec.temperature_change) return fields.add(body, *spec.temperature_change);
  for (const Field& component : spec.strain) fields.add(body, component);
}

std::vector<CellPiece> BodyFields::pieces(const Cell& cell) const {
  if (!any(cell.body)) return {};
  return resolving_pieces(mesh_.nodes, cell, fields_[cell.body]);
}

CellRule BodyFields::rule(const Cell& cell) const {
  if (!any(cell.body)) return {};
  const std::vector<CellPiece> cut = pieces(cell);
  return piece_rule(cut.empty() ? std::vector{whole_cell(cell.kind)} : cut);
}

}  // namespace mortise
