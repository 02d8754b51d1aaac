#include "contact/seen_motions.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/vectors.hpp"

namespace mortise {
namespace {

constexpr double exact = 1e-6;  // of the curve's size: what gmsh's kernels and the digits of files leave of an arc

using Kind = Symmetry::Kind;

// What a motion (translation at `about`, turn times `size`) moves along normals is zero.
Symmetry unseen_by(const std::vector<ContactNormal>& normals, const Vec2& about, double size) {
  MatX gram = MatX::Zero(3, 3);
  for (const ContactNormal& at : normals) {
    const Vec2 arm = (at.position - about) / size;
    const Eigen::Vector3d row(at.normal.x(), at.normal.y(), cross(arm, at.normal));
    gram += row * row.transpose();
  }
  const SymmetricEigen eigen = symmetric_eigen(gram);
  const double limit = exact * exact * double(normals.size());
  Symmetry found;
  if (eigen.values(0) > limit || eigen.values(1) <= limit) return found;
  const Eigen::Vector3d motion = eigen.vectors.col(0);
  const Vec2 along = motion.head<2>();
  if (std::abs(motion(2)) < exact * along.norm()) {
    found.kind = Kind::slide;
    found.direction = along.normalized();
  } else {
    found.kind = Kind::turn;
    found.centre = about + size / motion(2) * Vec2(-along.y(), along.x());
  }
  return found;
}

// Whether the drawn curve between the ends of each edge stays what it is.
bool leaves(const Symmetry& s, const EdgeSamples& edge, double size) {
  const Vec2& start = edge.pieces.front().places.front();
  const auto stays = [&](const Vec2& place) {
    const double moved = s.kind == Kind::turn ? (place - s.centre).norm() - (start - s.centre).norm()
                                              : cross(s.direction, Vec2(place - start));
    return std::abs(moved) <= exact * size;
  };
  return std::ranges::all_of(edge.pieces,
                             [&](const SamplePiece& piece) { return std::ranges::all_of(piece.places, stays); });
}

bool same(const Symmetry& a, const Symmetry& b, double size) {
  if (a.kind != b.kind) return false;
  return a.kind == Kind::turn ? (a.centre - b.centre).norm() <= exact * size
                              : std::abs(cross(a.direction, b.direction)) <= exact;
}

// The only line along which motions of both kinds move nothing: through both centres, or through one at right angles to
// the slide; at the place on it that is nearest to `near`.
ContactNormal between(const Symmetry& a, const Symmetry& b, const Vec2& near, int body, int other) {
  const Symmetry &turn = a.kind == Kind::turn ? a : b, &second = a.kind == Kind::turn ? b : a;
  const Vec2 along = second.kind == Kind::turn ? Vec2((second.centre - turn.centre).normalized())
                                               : Vec2(-second.direction.y(), second.direction.x());
  return {turn.centre + along * along.dot(near - turn.centre), along, body, other};
}

struct Side {
  SmoothNormals normals;
  Symmetry symmetry;
  Vec2 middle;
  double size;
};

Side side(const Points& nodes, const Curve& curve, int other, const std::vector<char>& faces) {
  Side found{smooth_normals(nodes, curve, other, faces), {}, Vec2::Zero(), 0};
  const std::vector<ContactNormal>& at = found.normals.normals;
  if (at.empty()) return found;
  for (const ContactNormal& normal : at) found.middle += normal.position / double(at.size());
  for (const ContactNormal& normal : at) found.size = std::max(found.size, (normal.position - found.middle).norm());
  if (!(found.size > 0)) return found;
  found.symmetry = unseen_by(at, found.middle, found.size);
  if (found.symmetry.kind == Kind::none) return found;
  for (std::size_t i = 0; i < curve.samples.size(); ++i)
    if (faces[i] && !leaves(found.symmetry, curve.samples[i], found.size)) found.symmetry = {};
  return found;
}

}  // namespace

Symmetry symmetry(const Points& nodes, const Curve& curve, const std::vector<char>& faces) {
  return side(nodes, curve, -1, faces).symmetry;
}

SmoothNormals seen_motions(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                           const std::vector<ContactPoint>& points) {
  std::vector<char> faces(multiplier.edges.size(), 0), faced(opposite.edges.size(), 0);
  for (const ContactPoint& point : points) faces[point.edge] = faced[point.opposite_edge] = 1;
  Side a = side(nodes, multiplier, opposite.body, faces);
  const Side b = side(nodes, opposite, multiplier.body, faced);
  a.normals.edge_error = std::max(a.normals.edge_error, b.normals.edge_error);
  if (b.symmetry.kind == Kind::none || same(a.symmetry, b.symmetry, a.size)) return std::move(a.normals);
  if (a.symmetry.kind == Kind::none)
    a.normals.normals = b.normals.normals;
  else if (a.symmetry.kind == Kind::turn || b.symmetry.kind == Kind::turn)
    a.normals.normals = {between(a.symmetry, b.symmetry, a.middle, multiplier.body, opposite.body)};
  else  // lines that are not parallel meet at a corner
    a.normals.normals.insert(a.normals.normals.end(), b.normals.normals.begin(), b.normals.normals.end());
  return std::move(a.normals);
}

}  // namespace mortise
