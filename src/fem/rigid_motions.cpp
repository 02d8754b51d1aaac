#include "fem/rigid_motions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/columns.hpp"
#include "base/null_space.hpp"
#include "base/union_find.hpp"

namespace mortise {
namespace {

constexpr double least_part = 1e-7;  // of a motion; conditions that see less of it do not resist it

// Motion k of a body (0, 1: translations; 2: rotation by 1/size) at x, component c.
double motion_at(int k, const Vec2& x, const Vec2& centre, double size, int c) {
  if (k < 2) return k == c ? 1 : 0;
  return c == 0 ? -(x.y() - centre.y()) / size : (x.x() - centre.x()) / size;
}

// What is asked of the 3 motions of each body: 3 columns a body.
struct Bodies {
  explicit Bodies(const Mesh& of) : mesh(of), points(body_points(of)), frames(body_frames(of, points)) {}

  Eigen::Index columns() const { return 3 * mesh.bodies.size(); }
  // Component c of the motions of body b at x.
  Eigen::RowVector3d at(int b, const Vec2& x, int c) const {
    Eigen::RowVector3d motion;
    for (int k = 0; k < 3; ++k) motion(k) = motion_at(k, x, frames.centre[b], frames.size[b], c);
    return motion;
  }
  // Calls visit(body, node, position) for each node of each body.
  template <typename Visit>
  void for_each_node(Visit visit) const {
    for (int b = 0; b < int(mesh.bodies.size()); ++b)
      for (int p = points.first[b]; p < points.first[b + 1]; ++p)
        visit(b, points.node[p], Vec2(mesh.nodes.row(points.node[p]).transpose()));
  }

  const Mesh& mesh;
  BodyPoints points;
  BodyFrames frames;
};

// What a condition sees of the motions of bodies: three numbers a body, few bodies.
using Seen = std::vector<std::pair<int, Eigen::RowVector3d>>;

// Gram matrix of what conditions see: a block of 3 x 3 for each two bodies that one condition sees.
class Gram {
 public:
  using Block = Eigen::Matrix3d;

  explicit Gram(int bodies) : bodies_(bodies) {}

  void add(const Seen& seen) {
    for (const auto& [a, of_a] : seen)
      for (const auto& [b, of_b] : seen)
        blocks_.try_emplace({a, b}, Block::Zero()).first->second += of_a.transpose() * of_b;
  }

  // Not less than the largest eigenvalue: the largest sum of a row's entries without their signs.
  double size() const {
    VecX sums = VecX::Zero(3 * bodies_);
    for (const auto& [at, block] : blocks_) sums.segment<3>(3 * at.first) += block.cwiseAbs().rowwise().sum();
    return sums.size() > 0 ? sums.maxCoeff() : 0;
  }

  // Bodies that conditions see together.
  std::vector<std::vector<int>> connected() const {
    UnionFind bodies(bodies_);
    for (const auto& [at, block] : blocks_) bodies.join(at.first, at.second);
    return bodies.sets();
  }

  Block of_body(int body) const {
    const auto found = blocks_.find({body, body});
    return found == blocks_.end() ? Block::Zero() : found->second;
  }

  // Of a connected set, ascending, with `held` added to the blocks of its bodies.
  SparseMatrix of_bodies(const std::vector<int>& set, const std::vector<Block>& held) const {
    Triplets entries;
    const auto append = [&](int i, int j, const Block& block) {
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) entries.emplace_back(3 * i + r, 3 * j + c, block(r, c));
    };
    for (int i = 0; i < int(set.size()); ++i) {
      append(i, i, held[i]);
      for (auto at = blocks_.lower_bound({set[i], 0}); at != blocks_.end() && at->first.first == set[i]; ++at)
        append(i, int(std::ranges::lower_bound(set, at->first.second) - set.begin()), at->second);
    }
    return filled(3 * set.size(), 3 * set.size(), entries);
  }

 private:
  int bodies_;
  std::map<std::pair<int, int>, Block> blocks_;
};

// How the motions open the rows. Of a shared node only the first body counts.
void add_openings(const Bodies& bodies, const SparseMatrix& rows, Gram& gram) {
  std::vector<std::map<int, Eigen::RowVector3d>> openings(rows.rows());
  std::vector<char> counted(bodies.mesh.nodes.rows(), 0);
  bodies.for_each_node([&](int b, int node, const Vec2& x) {
    if (counted[node]) return;
    counted[node] = 1;
    for (int c = 0; c < 2; ++c)
      for (SparseMatrix::InnerIterator it(rows, 2 * node + c); it; ++it)
        openings[it.row()].try_emplace(b, Eigen::RowVector3d::Zero()).first->second += it.value() * bodies.at(b, x, c);
  });
  for (const auto& opening : openings) gram.add({opening.begin(), opening.end()});
}

// The prescribed q that are not unknowns of u, by u.
SparseMatrix prescribed_couplings(const Constraints& constraints) {
  SparseRows rows = constraints.multipoint->inverse;
  rows.prune(
      [&](Eigen::Index q, Eigen::Index, double) { return constraints.fixed[q] && constraints.multipoint->coupled[q]; });
  return rows;
}

// The springs' rows by what their work is of that of the elements: where that is round-off of these, no factor tells
// that the springs are there.
SparseMatrix resisting(const Constraints& constraints) {
  constexpr double round_off = 1e-13;  // that a factor leaves of a stiffness
  const VecX weights = (least_part * least_part / round_off * constraints.spring_parts).cwiseSqrt().cwiseMin(1);
  return weights.asDiagonal() * constraints.springs;
}

// What the constraints and springs see of the motions, and the jumps between bodies that share nodes: they move
// together.
void add_supports(const Bodies& bodies, const Constraints& constraints, Gram& gram) {
  if (constraints.rings)  // all but translations along x2 strain them
    for (int b = 0; b < int(bodies.mesh.bodies.size()); ++b)
      for (const int k : {0, 2}) gram.add({{b, Eigen::RowVector3d::Unit(k)}});
  if (constraints.springs.cols() > 0) add_openings(bodies, resisting(constraints), gram);
  if (constraints.multipoint) add_openings(bodies, prescribed_couplings(constraints), gram);
  const auto is_own = [&](int unknown) {
    return constraints.fixed[unknown] && !(constraints.multipoint && constraints.multipoint->coupled[unknown]);
  };
  std::vector<int> owner(bodies.mesh.nodes.rows(), -1);
  bodies.for_each_node([&](int b, int node, const Vec2& x) {
    const int other = owner[node];
    if (other < 0) owner[node] = b;
    for (int c = 0; c < 2; ++c) {
      if (is_own(2 * node + c)) gram.add({{b, bodies.at(b, x, c)}});
      if (other >= 0) gram.add({{b, bodies.at(b, x, c)}, {other, -bodies.at(other, x, c)}});
    }
  });
}

void add_openings(const Bodies& bodies, const std::vector<ContactNormal>& normals, Gram& gram) {
  for (const ContactNormal& at : normals) {
    Eigen::RowVector3d of_body = Eigen::RowVector3d::Zero(), of_other = of_body;
    for (int c = 0; c < 2; ++c) {
      of_body -= at.normal(c) * bodies.at(at.body, at.position, c);
      if (at.other >= 0) of_other += at.normal(c) * bodies.at(at.other, at.position, c);
    }
    if (at.other >= 0)
      gram.add({{at.body, of_body}, {at.other, of_other}});
    else
      gram.add({{at.body, of_body}});
  }
}

using Motions = std::vector<std::vector<RigidMotion>>;

// A column of three numbers a body as a motion.
std::vector<RigidMotion> as_motion(const Bodies& bodies, const std::vector<int>& set, const VecX& column) {
  std::vector<RigidMotion> motion;
  for (int i = 0; i < int(set.size()); ++i) {
    const Eigen::Vector3d of_body = column.segment<3>(3 * i);
    if (of_body.norm() > 1e-6)
      motion.push_back(
          {set[i], of_body.head<2>(), of_body(2) / bodies.frames.size[set[i]], bodies.frames.centre[set[i]]});
  }
  return motion;
}

// Motions of a connected set with eigenvalues of at most `limit`: those of single bodies, then of several together.
void add_unresisted(const Bodies& bodies, const Gram& gram, const std::vector<int>& set, double limit,
                    Motions& motions) {
  std::vector<Gram::Block> held;
  const auto add = [&](const std::vector<int>& moved, const MatX& columns) {
    const MatX apart = told_apart(columns);
    for (const auto& column : apart.colwise()) motions.push_back(as_motion(bodies, moved, column));
  };
  for (const int body : set) {
    const MatX alone = null_space(gram.of_body(body).sparseView(), limit);
    add({body}, alone);
    held.push_back(alone * alone.transpose());
  }
  if (set.size() > 1) add(set, null_space(gram.of_bodies(set, held), limit));
}

// Motions that the conditions resist by less than `part` of their size.
Motions unresisted(const Bodies& bodies, const Gram& gram, double part) {
  const double limit = part * part * std::max(1.0, gram.size());  // relative to one fixed node
  Motions motions;
  for (const std::vector<int>& set : gram.connected()) add_unresisted(bodies, gram, set, limit, motions);
  std::ranges::stable_sort(motions, {}, [](const auto& motion) { return motion.front().body; });
  return motions;
}

}  // namespace

BodyFrames body_frames(const Mesh& mesh, const BodyPoints& points) {
  BodyFrames frames;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    Eigen::AlignedBox2d box;
    for (int p = points.first[b]; p < points.first[b + 1]; ++p) box.extend(mesh.nodes.row(points.node[p]).transpose());
    frames.centre.push_back((box.min() + box.max()) / 2);
    frames.size.push_back(box.diagonal().norm() / 2);
  }
  return frames;
}

std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const SparseMatrix& rows) {
  const Bodies bodies(mesh);
  Gram gram(int(mesh.bodies.size()));
  add_supports(bodies, constraints, gram);
  add_openings(bodies, rows, gram);
  return unresisted(bodies, gram, least_part);
}

std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const std::vector<ContactNormal>& normals) {
  const Bodies bodies(mesh);
  Gram gram(int(mesh.bodies.size()));
  add_supports(bodies, constraints, gram);
  add_openings(bodies, normals, gram);
  return unresisted(bodies, gram, 1e-6);
}

std::string describe(const Mesh& mesh, const std::vector<RigidMotion>& motion) {
  const double length = (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm();
  const auto turned = [&](const RigidMotion& m) { return std::abs(m.rotation) * length; };
  double size = 0;
  for (const RigidMotion& m : motion) size = std::max({size, m.translation.norm(), turned(m)});
  std::ostringstream text;
  text.precision(3);
  const auto write = [&](const Vec2& x, double largest) {  // round-off is 0
    const auto shown = [&](double value) { return std::abs(value) < 1e-6 * largest ? 0 : value; };
    text << "(" << shown(x.x()) << ", " << shown(x.y()) << ")";
  };
  const char* separator = "";
  for (const RigidMotion& m : motion) {
    const bool turns = turned(m) > 1e-4 * m.translation.norm();  // else about a place that is out of sight
    if ((turns ? turned(m) : m.translation.norm()) < 1e-6 * size) continue;
    text << separator << "body '" << mesh.bodies[m.body] << "': ";
    separator = "; ";
    if (turns) {
      text << (m.rotation < 0 ? "clockwise rotation about " : "rotation about ");
      write(m.centre + Vec2(-m.translation.y(), m.translation.x()) / m.rotation, length);
    } else {
      text << "translation ";
      write(m.translation, size);
    }
  }
  return text.str();
}

}  // namespace mortise
