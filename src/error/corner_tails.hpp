// What a mesh misses of the stresses at the bodies' own corners, slits and ends of supports, and what that does to a
// dual's functional far from them. docs/theory.md, section 14.
#pragma once

#include "contact/body_corners.hpp"
#include "error/dual_sums.hpp"

namespace mortise {

/// A corner and the cells around it.
struct CornerRings {
  BodyCorner corner;
  std::array<std::vector<int>, 2> cells;  ///< that have its node, and those next to them
  std::array<double, 2> radius{0, 0};     ///< of the first ring, and of both: length
  int degree = 1;                         ///< of the stresses in the cells: 1 of quadratic ones, 0 of linear ones
};

/// The cells that have one of the nodes, and those next to them.
std::array<std::vector<int>, 2> rings_about(const Mesh& mesh, const SideTable& table, const std::vector<int>& nodes);

std::vector<CornerRings> corner_rings(const Mesh& mesh, const SideTable& table, const std::vector<BodyCorner>& corners);

/// Of the energy of r^(exponent - 1) about a corner what polynomials of a degree in r miss at best, 0 ... 1:
/// prod_n ((1 - lambda + n) / (1 + lambda + n))^2, n = 0 ... degree (Muentz).
double missed_energy(double exponent, int degree);

/// By which a solution misses more than missed_energy, as stresses turn about a corner too and displacements are
/// continuous: windows' means on 6-node triangles were off by 3.0 times that (270 degrees, four of them), 4.3
/// (270), 4.8 (300) and 6.7 (345), at cells of 0.004 to 0.00012 of the bodies' size.
inline constexpr double missed_more = 6;

/// Of fields of displacements at all corners: int sigma_0 : eps_k over the first ring and over both, times depth.
class CornerProducts {
 public:
  CornerProducts(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const std::vector<CornerRings>& corners)
      : mesh_(mesh), laws_(laws), corners_(corners) {}

  /// Those whose columns follow the ones that were added before.
  void add(const VecX& u, const DualSums& fields);

  /// Corners x columns: of int sigma(u) : eps_k the part a r^(2 lambda) that grows from the corner, fitted beside b r^2
  /// to both rings, without its sign, times missed_energy and missed_more.
  MatX tails() const;

 private:
  void add_cell(int cell, const VecX& u, const DualSums& fields, Eigen::Ref<Eigen::RowVectorXd> sums) const;

  const Mesh& mesh_;
  const std::vector<ElasticLaw>& laws_;
  const std::vector<CornerRings>& corners_;
  std::array<MatX, 2> products_;  // corners x columns: of the first ring, of the second
};

}  // namespace mortise
