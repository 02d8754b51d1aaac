#include "error/force_errors.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <optional>

#include "error/body_products.hpp"
#include "fem/edges.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {
namespace {

constexpr double determinate = 1e-9;  // of a unit motion: what a rigid motion may miss of it by round-off

// Of unknown i in the motion of component c (x, y, a turn about the centre).
double unit_motion(const Mesh& mesh, int i, int c, const Vec2& centre) {
  if (c < 2) return i % 2 == c ? 1 : 0;
  const Vec2 arm = mesh.nodes.row(i / 2).transpose() - centre;
  return i % 2 == 0 ? -arm.y() : arm.x();
}

struct Asked {
  std::size_t place;
  int component;  // x, y, the moment
};

// What the functionals ask of their dual solutions.
class Motions {
 public:
  Motions(const Mesh& mesh, const SaddlePointSystem& system, const std::vector<ContactPair>& pairs,
          const std::vector<ForcePlace>& places)
      : mesh_(mesh), system_(system), pairs_(pairs), places_(places) {}

  // n: of the supports; zero of the force of a pair.
  VecX of_supports(const Asked& asked) const {
    const ForcePlace& place = places_[asked.place];
    return place.pair < 0 ? motion(place.unknowns, asked) : VecX::Zero(system_.K.cols());
  }

  // m: by how much the rows are to open; zero of supports.
  VecX of_rows(const Asked& asked) const {
    VecX rows = VecX::Zero(system_.B.rows());
    const ForcePlace& place = places_[asked.place];
    if (place.pair < 0) return rows;
    const ContactPair& pair = pairs_[place.pair];
    std::vector<int> unknowns;
    for (const int node : curve_nodes(pair.multiplier))
      for (const int c : {0, 1}) unknowns.push_back(2 * node + c);
    rows.segment(pair.first_row, pair.coupling.B.rows()) = pair.coupling.B * motion(unknowns, asked);
    return rows;
  }

 private:
  VecX motion(const std::vector<int>& unknowns, const Asked& asked) const {
    VecX u = VecX::Zero(system_.K.cols());
    for (const int i : unknowns) u(i) = unit_motion(mesh_, i, asked.component, places_[asked.place].centre);
    return u;
  }

  const Mesh& mesh_;
  const SaddlePointSystem& system_;
  const std::vector<ContactPair>& pairs_;
  const std::vector<ForcePlace>& places_;
};

// Columns n: rigid motions of bodies that hang together, those of rings along the axis only.
MatX rigid_motions(const Mesh& mesh, const BodyPoints& points, bool rings) {
  const std::vector<int> bonded = bonded_to(mesh, points);
  const int motions = rings ? 1 : 3;
  std::vector<int> first(bonded.size(), -1);
  int count = 0;
  for (std::size_t b = 0; b < bonded.size(); ++b)
    if (bonded[b] == int(b)) {
      first[b] = count;
      count += motions;
    }
  MatX columns = MatX::Zero(2 * mesh.nodes.rows(), count);
  for (std::size_t b = 0; b < bonded.size(); ++b)
    for (int p = points.first[b]; p < points.first[b + 1]; ++p)
      for (int i = 2 * points.node[p]; i < 2 * points.node[p] + 2; ++i)
        for (int c = 0; c < motions; ++c)
          columns(i, first[bonded[b]] + c) = unit_motion(mesh, i, rings ? 1 : c, Vec2::Zero());
  return columns;
}

// Whether equilibrium fixes a force: a rigid motion of the bodies moves all that is prescribed as the functional asks.
class Statics {
 public:
  Statics(const Mesh& mesh, const BodyPoints& points, const SaddlePointSystem& system) : system_(system) {
    if (system.constraints.multipoint) return;
    motions_ = rigid_motions(mesh, points, system.constraints.rings);
    for (int i = 0; i < int(system.constraints.fixed.size()); ++i)
      if (system.constraints.fixed[i]) fixed_.push_back(i);
    const MatX of_rows = system.row_scale.cwiseInverse().asDiagonal() * (system.B * motions_).eval();
    const SparseMatrix& springs = system.constraints.springs;
    const MatX of_springs = springs.cols() > 0 ? MatX(springs * motions_) : MatX(0, motions_.cols());
    all_.resize(of_rows.rows() + Eigen::Index(fixed_.size()) + of_springs.rows(), motions_.cols());
    all_ << of_rows, motions_(fixed_, Eigen::all), of_springs;
    if (all_.size() > 0) factor_.compute(all_);
  }

  // That motion, n.
  std::optional<VecX> motion(const VecX& rows, const VecX& moved) const {
    if (all_.size() == 0) return std::nullopt;
    VecX wanted = VecX::Zero(all_.rows());
    wanted.head(rows.size()) = rows.cwiseQuotient(system_.row_scale);
    wanted.segment(rows.size(), Eigen::Index(fixed_.size())) = moved(fixed_);
    const VecX parts = factor_.solve(wanted);
    if (!(largest_entry(wanted - all_ * parts) <= determinate * largest_entry(wanted))) return std::nullopt;
    return motions_ * parts;
  }

 private:
  const SaddlePointSystem& system_;
  std::vector<int> fixed_;
  MatX motions_, all_;  // n x motions; of these what is held at zero
  Eigen::ColPivHouseholderQR<MatX> factor_;
};

// Of each unknown the force that the solution leaves, where none is held, and round-off of the load.
VecX what_is_left(const SaddlePointSystem& s, const Solution& solution) {
  VecX left = (s.f - s.K.selfadjointView<Eigen::Lower>() * solution.u - s.B.transpose() * solution.lambda).cwiseAbs();
  for (Eigen::Index i = 0; i < left.size(); ++i)
    if (s.constraints.fixed[i]) left(i) = 0;
  return left + std::numeric_limits<double>::epsilon() * s.f.cwiseAbs();
}

// At each contact point of a pair a unit motion of the multiplier side along its normal.
VecX along_normals(const Mesh& mesh, const ContactPair& pair, int component, const Vec2& centre) {
  VecX along(Eigen::Index(pair.points.size()));
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const ContactPoint& point = pair.points[i];
    const Vec2 arm = edge_point(mesh.nodes, pair.multiplier.edges[point.edge], point.xi).position - centre;
    const Vec2 motion = component < 2 ? Vec2(Vec2::Unit(component)) : Vec2(-arm.y(), arm.x());
    along(i) = point.normal.dot(motion);
  }
  return along;
}

// What the bodies' error and that of p on all lines do to each.
VecX errors_by_duals(const Mesh& mesh, const BodyPoints& points, const Discretisation& d,
                     const std::vector<ContactPair>& pairs, const Solution& solution,
                     const std::vector<PressureEstimate>& pressures, const std::vector<ForcePlace>& places,
                     const Motions& motions, const std::vector<Asked>& asked) {
  const SaddlePointSystem& s = d.system;
  const auto count = Eigen::Index(asked.size());
  MatX rows(s.B.rows(), count), loads(s.K.cols(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const VecX moved = motions.of_supports(asked[k]);
    rows.col(k) = motions.of_rows(asked[k]) - s.B * moved;
    loads.col(k) = -(s.K.selfadjointView<Eigen::Lower>() * moved);
  }
  VecX errors = VecX::Zero(count);
  const auto add_lines = [&](Eigen::Index first, MatX& fields) {
    auto z = fields.rightCols(fields.cols() - 1);
    for (Eigen::Index k = 0; k < z.cols(); ++k) z.col(k) += motions.of_supports(asked[first + k]);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      MatX opened = openings(pairs[p], z);
      for (Eigen::Index k = 0; k < z.cols(); ++k) {
        const Asked& one = asked[first + k];
        if (places[one.place].pair == int(p))
          opened.col(k) += along_normals(mesh, pairs[p], one.component, places[one.place].centre);
      }
      errors.segment(first, z.cols()) += line_part(pairs[p], pressures[p].line, pressures[p].local, opened).sum();
    }
  };
  std::shared_ptr<const ContactFactor> factor = solution.factor;
  if (!factor) factor = factorise_contact(s, solution.active);
  const ErrorProducts found = products_with_duals(mesh, points, d.laws, solution.u, *factor, rows, loads, add_lines);
  return errors + found.products.rightCols(count).cwiseAbs().colwise().sum().transpose();
}

// By the bars of p: force along x and y, and moment.
Eigen::Vector3d sum_of_bars(const Mesh& mesh, const ContactPair& pair, const PressureEstimate& estimate,
                            const Vec2& centre) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::array<VecX, 3> along{along_normals(mesh, pair, 0, centre), along_normals(mesh, pair, 1, centre),
                                  along_normals(mesh, pair, 2, centre)};
  for (std::size_t i = 0; i < pair.points.size(); ++i) {
    const ContactPoint& point = pair.points[i];
    const double end = (1 + point.xi) / 2,
                 bar = (1 - end) * estimate.bar(point.edge) + end * estimate.bar(point.edge + 1);
    for (int c = 0; c < 3; ++c) sum(c) += point.dA * bar * std::abs(along[c](Eigen::Index(i)));
  }
  return sum;
}

}  // namespace

std::vector<Eigen::Vector3d> force_errors(const Mesh& mesh, const BodyPoints& points, const Discretisation& d,
                                          const std::vector<ContactPair>& pairs, const Solution& solution,
                                          const std::vector<PressureEstimate>& pressures,
                                          const std::vector<ForcePlace>& places) {
  std::vector<Eigen::Vector3d> errors(places.size(),
                                      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  const Motions motions(mesh, d.system, pairs, places);
  std::vector<Asked> asked;
  if (pairs.size() <= std::size_t(most_own_duals) && mesh.bodies.size() <= std::size_t(most_own_duals)) {
    const Statics statics(mesh, points, d.system);
    const VecX left = what_is_left(d.system, solution);
    for (std::size_t k = 0; k < places.size(); ++k)
      for (int c = 0; c < 3; ++c) {
        const Asked one{k, c};
        if (const auto motion = statics.motion(motions.of_rows(one), motions.of_supports(one)))
          errors[k](c) = left.dot(motion->cwiseAbs());
        else if (places[k].pair >= 0 || !d.system.constraints.multipoint)
          asked.push_back(one);
      }
  }
  if (!asked.empty() && asked.size() <= std::size_t(most_own_duals)) {
    const VecX found = errors_by_duals(mesh, points, d, pairs, solution, pressures, places, motions, asked);
    for (std::size_t k = 0; k < asked.size(); ++k)
      errors[asked[k].place](asked[k].component) = error_safety * found(Eigen::Index(k));
  }
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k].pair >= 0) {
      const Eigen::Vector3d bars =
          sum_of_bars(mesh, pairs[places[k].pair], pressures[places[k].pair], places[k].centre);
      for (int c = 0; c < 3; ++c)
        if (std::isnan(errors[k](c))) errors[k](c) = bars(c);
    }
  return errors;
}

}  // namespace mortise
