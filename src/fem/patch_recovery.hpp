// Stresses that are better than the elements' own, and the energy error that they show.
#pragma once

#include <optional>
#include <span>

#include "fem/locate.hpp"
#include "fem/stress.hpp"

namespace mortise {

/// Stresses C : eps(u) of F displacement fields, initial strains left out: 3 F columns, (11, 22, 12) of each field,
/// from which 33 follows; of rings 4 F, (11, 22, 12, 33).
using FieldStresses = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Stresses at the superconvergent points of all cells (fem/quadrature.hpp stress_points): those of cell e are
/// first[e] .. first[e + 1] - 1.
struct StressSamples {
  std::vector<int> first{0};
  std::vector<Vec2> x;
  FieldStresses stresses;  ///< a row a sample
};

/// `fields`: n x F, displacements. `laws`: of one model.
StressSamples sample_stresses(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const MatX& fields);

/// 1, x, y, x^2, xy, y^2.
using Monomials = Eigen::Matrix<double, 6, 1>;

/// Stresses as polynomials about vertices.
struct StressPatches {
  std::vector<Vec2> centre;  ///< of each body point
  std::vector<double> size;  ///< of each patch, length: the polynomial is in (x - centre) / size
  std::vector<int> terms;    ///< 1, 3 or 6 of the monomials; 0: no vertex
  std::vector<int> row;      ///< of each body point: the first of its six rows; -1: no vertex
  FieldStresses coefficients;

  /// Of patch p.
  Monomials monomials_at(int p, const Vec2& place) const {
    const Vec2 x = (place - centre[p]) / size[p];
    return {1, x.x(), x.y(), x.x() * x.x(), x.x() * x.y(), x.y() * x.y()};
  }

  /// Adds factor times the stresses of patch p at x to `sum`, a row of stresses.
  void add_at(int p, const Vec2& x, double factor, Eigen::RowVectorXd& sum) const;
};

/// Superconvergent patch recovery (Zienkiewicz & Zhu 1992): at each vertex of each body (by body point) the polynomial
/// that fits the values at the superconvergent points of the cells around it in least squares, of degree 2 if these are
/// quadratic, else 1; where they are few, as on the boundary, the cells around these too. What the mesh alone makes of
/// it is found once.
class PatchRecovery {
 public:
  /// `samples`: their places count, of the cells that have some. `wanted`: flags of body points; empty: all vertices.
  PatchRecovery(const Mesh& mesh, const BodyPoints& points, const StressSamples& samples,
                const std::vector<char>& wanted = {});

  /// `samples`: at the same places.
  StressPatches fit(const StressSamples& samples) const;

 private:
  struct Patch {
    int point, first, last;  // of its cells in cells_
    std::size_t first_part;  // of its samples
  };
  Eigen::Matrix<double, 6, 6> inverse_at(int p, std::span<const int> cells, const StressSamples& samples);
  template <typename Row>
  void fit_patch(const Patch& patch, const StressSamples& samples, FieldStresses& coefficients) const;

  StressPatches empty_;  // without coefficients
  std::vector<Patch> patches_;
  std::vector<int> cells_;
  std::vector<Monomials> parts_;  // what each sample of a patch adds to its coefficients, the same for all fields
};

StressPatches recover_patches(const Mesh& mesh, const BodyPoints& points, const StressSamples& samples);

/// The same at some body points only, in the time that the cells around these take, and a look at all cells; of fields
/// that come one after another.
class LocalRecovery {
 public:
  LocalRecovery(std::vector<int> some, const Mesh& mesh, const BodyPoints& points);
  const std::vector<int>& at() const { return some_; }
  /// On the same mesh.
  StressPatches recover(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                        const MatX& fields);

 private:
  std::vector<int> some_;
  std::vector<char> wanted_, take_;  // of body points; of cells
  std::optional<PatchRecovery> recovery_;
};

/// The stresses of all fields at a place of a cell, a row: the patches of its vertices, blended by the linear shape
/// functions of its corners.
Eigen::RowVectorXd recovered_stress(const Mesh& mesh, const BodyPoints& points, const StressPatches& patches,
                                    const CellPlace& place);

/// The whole stress (11, 22, 33, 12) at x, initial strains included, of a recovered one.
Vec4 whole_stress(const std::vector<ElasticLaw>& laws, int body, const Eigen::RowVectorXd& recovered, const Vec2& x);

}  // namespace mortise
