#include "problem/data_misfit.hpp"

#include <algorithm>

#include "base/dense.hpp"
#include "base/overloaded.hpp"
#include "base/vectors.hpp"
#include "contact/outline.hpp"
#include "fem/edges.hpp"
#include "problem/body_fields.hpp"
#include "problem/boundary_fields.hpp"

namespace mortise {
namespace {

// Sums of an entry's function, and its worst edge or cell.
class Collector {
 public:
  Collector(std::string key, DataMisfits& found) : found_(found) { entry_.key = std::move(key); }
  ~Collector() {
    if (!(entry_.part > 0)) return;
    entry_.part /= all_;
    found_.entries.push_back(entry_);
  }
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  void add_all(double size) { all_ += size; }
  // `difference`: as the sums are. `length`: of the edge or cell.
  void add(const DataMisfit& part, double difference, double length) {
    found_.parts.push_back(part);
    entry_.part += difference;
    if (difference <= worst_) return;
    worst_ = difference;
    entry_.at = part.at;
    entry_.finest = part.finest;
    entry_.size = length;
  }

 private:
  DataMisfits& found_;
  EntryMisfit entry_{};
  double all_ = 0, worst_ = 0;
};

double mean_size(const LineFunction& f) {
  static const LineRule rule = gauss_legendre(4);
  double sum = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) sum += rule.weights[q] / 2 * std::abs(f.at(rule.points[q]));
  return sum;
}

// What entries are off by, one after the other.
class Misfits {
 public:
  Misfits(const Mesh& mesh, const Model& model) : mesh_(mesh), model_(model), table_(mesh) {}

  void add(const BoundaryEntry& entry);
  // Over bodies, by root mean squares; `values` of a strain such that their square is its energy density.
  void add_over(const std::string& key, DataMisfit::Kind kind, BodyFields& fields,
                const std::function<VecX(int body, const Vec2&)>& values);

  DataMisfits found;

 private:
  // Pressure, traction or foundation.
  void add_along(const BoundaryEntry& entry, const std::string& key, DataMisfit::Kind kind);
  // `direction`: of the displacement, by the outward normal of an edge.
  void add_displacement(const BoundaryEntry& entry, const Field& field,
                        const std::function<Vec2(const Vec2&)>& direction);

  const Mesh& mesh_;
  const Model& model_;
  SideTable table_;
};

void Misfits::add_along(const BoundaryEntry& entry, const std::string& key, DataMisfit::Kind kind) {
  const BoundaryFields fields(mesh_, entry.curves, fields_of(entry.spec.what));
  for (std::size_t k = 0; k < fields.count(); ++k) {
    Collector collector(entry.spec.key + key, found);
    for (const NamedBoundary& on : entry.curves) {
      const std::vector<Edge> edges = edges_of(mesh_, on);
      for (int e = 0; e < int(edges.size()); ++e) {
        const LineFunction f = fields.along(k, on, e, edges[e]);
        const std::vector<double> cuts = resolving_cuts(f);
        const double length = edge_length(mesh_.nodes, edges[e]);
        if (cuts.size() == 2) {
          collector.add_all(length * mean_size(f));
          continue;
        }
        const LineMisfit m = misfit(f, cuts);
        collector.add_all(length * m.mean_of_f);
        const Vec2 at = edge_point(mesh_.nodes, edges[e], m.at).position;
        collector.add({.kind = kind,
                       .cell = on.sides[e].cell,
                       .side = on.sides[e].side,
                       .size = m.mean * length * model_.depth(at.x()),
                       .at = at,
                       .finest = m.finest / 2 * length,
                       .sum = m.mean * length * model_.depth(at.x()),
                       .spread = m.mean / m.largest * length},
                      length * m.mean, length);
      }
    }
  }
}

// The cell side that an edge lies on; of a curve within a body one of the two.
std::optional<CellSide> side_of(const SideTable& table, const Edge& edge) {
  for (const SideAtNode& side : table.at(edge.nodes[0]))
    if (side.other == edge.nodes[1]) return side.side;
  return {};
}

void Misfits::add_displacement(const BoundaryEntry& entry, const Field& field,
                               const std::function<Vec2(const Vec2&)>& direction) {
  const BoundaryFields fields(mesh_, entry.curves, {&field});
  if (!fields.any()) return;
  const std::map<int, double> values = prescribed_values(mesh_, entry.curves, field);
  Collector collector(entry.spec.key + ".displacement", found);
  for (const NamedBoundary& on : entry.curves) {
    const std::vector<Edge> edges = edges_of(mesh_, on);
    for (int e = 0; e < int(edges.size()); ++e) {
      const Edge& edge = edges[e];
      const LineFunction g = fields.along(0, on, e, edge);
      const double length = edge_length(mesh_.nodes, edge);
      const std::vector<double> cuts = resolving_cuts(g);
      collector.add_all(length * g.scale);
      if (cuts.size() == 2) continue;
      const auto side = side_of(table_, edge);
      if (!side) continue;
      const LineRule rule = cut_rule(cuts, 4);
      DataMisfit part{.kind = DataMisfit::Kind::displacement,
                      .cell = side->cell,
                      .side = side->side,
                      .size = 0,
                      .at = Vec2::Zero(),
                      .finest = misfit(g, cuts).finest / 2 * length};
      double sum = 0, worst = -1;
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const EdgePoint p = edge_point(mesh_.nodes, edge, rule.points[q]);
        const EdgeShape shape = edge_shape(edge.node_count, rule.points[q]);
        double difference = g.at(rule.points[q]);
        for (int a = 0; a < edge.node_count; ++a) difference -= shape.N[a] * values.at(edge.nodes[a]);
        const double ds = rule.weights[q] * p.jacobian(), dA = ds * model_.depth(p.position.x());
        sum += ds * std::abs(difference);
        part.size += dA * std::abs(difference);
        part.mean += dA * difference * direction(p.normal());
        if (std::abs(difference) <= worst) continue;
        worst = std::abs(difference);
        part.at = p.position;
      }
      collector.add(part, sum, length);
    }
  }
}

void Misfits::add(const BoundaryEntry& entry) {
  if (std::ranges::all_of(fields_of(entry.spec.what), [](const Field* field) { return field->is_constant(); })) return;
  using enum DataMisfit::Kind;
  std::visit(
      Overloaded{
          [&](const Displacement& u) {
            if (u.x) add_displacement(entry, *u.x, [](const Vec2&) -> Vec2 { return Vec2::UnitX(); });
            if (u.y) add_displacement(entry, *u.y, [](const Vec2&) -> Vec2 { return Vec2::UnitY(); });
          },
          [&](const NormalDisplacement& u) { add_displacement(entry, u.value, [](const Vec2& n) { return n; }); },
          [&](const DirectedDisplacement& u) {
            add_displacement(entry, u.value, [&](const Vec2&) { return u.direction; });
          },
          [](const RigidSpec&) {}, [&](const Pressure&) { add_along(entry, ".pressure", force); },
          [&](const SurfaceTraction&) { add_along(entry, ".traction", force); }, [](const TotalForce&) {},
          [&](const NormalFoundation&) { add_along(entry, ".foundation", foundation); },
          [&](const AxesFoundation&) { add_along(entry, ".foundation", foundation); }, [](const PointSpring&) {}},
      entry.spec.what);
}

double corner_area(const Mesh& mesh, const Cell& cell) {
  const auto at = [&](int a) -> Vec2 { return mesh.nodes.row(cell.nodes[a]).transpose(); };
  double twice = 0;
  for (int a = 2; a < corner_count(cell.kind); ++a) twice += cross(Vec2(at(a - 1) - at(0)), Vec2(at(a) - at(0)));
  return twice / 2;
}

void Misfits::add_over(const std::string& key, DataMisfit::Kind kind, BodyFields& fields,
                       const std::function<VecX(int body, const Vec2&)>& values) {
  fields.find_scales();
  if (!fields.any()) return;
  Collector collector(key, found);
  for (int e = 0; e < int(mesh_.cells.size()); ++e) {
    const Cell& cell = mesh_.cells[e];
    const double area = corner_area(mesh_, cell);
    const Vec2 centre = centre_of(mesh_.nodes, cell);
    const std::vector<CellPiece> pieces = fields.pieces(cell);
    if (fields.any(cell.body)) collector.add_all(area * values(cell.body, centre).norm());
    if (pieces.empty()) continue;
    // Stresses that are recovered follow those of a smooth strain: fem/patch_recovery.hpp.
    const int degree = kind == DataMisfit::Kind::strain && is_quadratic(cell.kind) ? 2 : 1;
    const CellMisfit m = misfit(mesh_.nodes, cell, pieces, degree, [&](const Vec2& x) { return values(cell.body, x); });
    const double volume = area * model_.depth(centre.x());
    collector.add({.kind = kind,
                   .cell = e,
                   .size = m.root_mean_square * (kind == DataMisfit::Kind::strain ? std::sqrt(volume) : volume),
                   .at = m.at,
                   .finest = m.finest,
                   .sum = m.mean * volume,
                   .spread = m.mean / m.root_mean_square * std::sqrt(area)},
                  area * m.root_mean_square, std::sqrt(area));
  }
}

// Of a stiffness, (11, 22, 33, gamma_12), which plane stress leaves semidefinite.
Mat4 root_of(const Mat4& stiffness) {
  const SymmetricEigen eigen = symmetric_eigen(stiffness);
  return eigen.values.cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.vectors.transpose();
}

bool has_functions(const Entries& entries) {
  const auto varies = [](const Field& field) { return !field.is_constant(); };
  return std::ranges::any_of(entries.boundaries,
                             [&](const BoundaryEntry& entry) {
                               return std::ranges::any_of(fields_of(entry.spec.what),
                                                          [&](const Field* f) { return varies(*f); });
                             }) ||
         std::ranges::any_of(entries.body_forces,
                             [](const BodyForceSpec& spec) { return !spec.force.is_constant(); }) ||
         std::ranges::any_of(entries.initial_strains, [&](const InitialStrainSpec& spec) {
           return spec.temperature_change ? varies(*spec.temperature_change) : std::ranges::any_of(spec.strain, varies);
         });
}

}  // namespace

DataMisfits data_misfits(const Entries& entries, const Mesh& mesh, const std::vector<ElasticLaw>& laws) {
  if (!has_functions(entries)) return {};
  Misfits misfits(mesh, entries.model);
  for (const BoundaryEntry& entry : entries.boundaries) misfits.add(entry);
  const std::vector<int>& body_forces = entries.body_force_of;
  for (int i = 0; i < int(entries.body_forces.size()); ++i) {
    const BodyForceSpec& spec = entries.body_forces[i];
    BodyFields fields(mesh);
    for (int b = 0; b < int(body_forces.size()); ++b)
      if (body_forces[b] == i) {
        fields.add(b, spec.force.x);
        fields.add(b, spec.force.y);
      }
    misfits.add_over(spec.key + ".force", DataMisfit::Kind::force, fields,
                     [&](int, const Vec2& x) -> VecX { return spec.force(x); });
  }
  const std::vector<int>& strains = entries.initial_strain_of;
  for (int i = 0; i < int(entries.initial_strains.size()); ++i) {
    const InitialStrainSpec& spec = entries.initial_strains[i];
    BodyFields fields(mesh);
    for (int b = 0; b < int(strains.size()); ++b)
      if (strains[b] == i) add_strain(spec, b, fields);
    if (!fields.any()) continue;
    std::vector<Mat4> roots;
    for (const ElasticLaw& law : laws) roots.push_back(root_of(law.stiffness));
    misfits.add_over(spec.key, DataMisfit::Kind::strain, fields, [&](int body, const Vec2& x) -> VecX {
      const Vec4 e = laws[body].initial_strain(x);
      return roots[body] * Vec4(e(0), e(1), e(2), 2 * e(3));
    });
  }
  return std::move(misfits.found);
}

std::vector<DataMisfit> outline_misfits(const Mesh& mesh, const Model& model) {
  std::vector<DataMisfit> parts;
  const Outline o = outline(boundary_edges(mesh), mesh.nodes);
  for (std::size_t e = 0; e < o.edges.size(); ++e) {
    const BoundaryEdge& at = o.edges[e];
    if (at.shared) continue;
    const double h = o.length[e];
    const Vec2 start = edge_point(o.nodes, at.edge, -1).tangent, end = edge_point(o.nodes, at.edge, 1).tangent;
    std::optional<double> curvature;  // the lesser of both ends: a corner of straight sides turns at one
    for (const int side : {0, 1}) {
      const int other = o.neighbour[e][side];
      if (other < 0 || o.turn[e][side] >= smooth_turn) continue;
      const Vec2 there = edge_point(o.nodes, o.edges[other].edge, side == 0 ? 1 : -1).tangent;
      const double turn = std::copysign(o.turn[e][side], side == 0 ? cross(there, start) : cross(end, there));
      const double bends = 2 * turn / (h + o.length[other]);
      if (!curvature || std::abs(bends) < std::abs(*curvature)) curvature = bends;
    }
    // Round-off turns a straight line, and a bent side's own turn is what a chord's neighbours would show.
    if (!curvature || !(std::abs(*curvature) * h > std::max(angle_between(start, end), 1e-7))) continue;
    const Vec2 middle = edge_point(o.nodes, at.edge, 0).position;
    parts.push_back({.kind = DataMisfit::Kind::outline,
                     .cell = at.side.cell,
                     .side = at.side.side,
                     .size = *curvature * h * h * h / 12 * model.depth(middle.x()),
                     .at = middle,
                     .finest = h});
  }
  return parts;
}

}  // namespace mortise
