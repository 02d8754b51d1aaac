// Cuts of an edge with which a function on it is integrated as it is: spikes, waves and jumps within the edge too.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fem/edges.hpp"
#include "fem/quadrature.hpp"
#include "mesh/mesh.hpp"
#include "model/field_range.hpp"
#include "model/model.hpp"

namespace mortise {

/// A function on an edge, -1 <= xi <= 1.
struct LineFunction {
  std::function<double(double xi)> at;
  /// An interval that contains all its values from one xi to another; nothing where that is not known.
  std::function<std::optional<Interval>(double from, double to)> range;
  /// What round-off may change the value at xi by: of its terms, and of the place.
  std::function<double(double xi)> round_off;
  double scale = 1;  ///< by how much it varies, > 0: tolerances are parts of it
};

/// By how much a field varies along curves (scale_of), from looking at each of their edges in four places.
class LineScale {
 public:
  void look_at(const LineFunction& f);
  double value() const;

 private:
  std::optional<Interval> values_, range_;
};

/// A field along an edge. `range`: its own. `s`: the arc length at xi; asked where the field uses it. What is given
/// must outlive the function, but for the edge. Its scale is 1.
LineFunction along_edge(const Points& nodes, const Edge& edge, const Field& field, const FieldRange& range,
                        const std::function<double(double xi)>& s);

/// Cuts, ascending, from -1 to 1: between two of them four Gauss points integrate f, f xi and f xi^2 to 1e-9 of the
/// scale, or as near as round-off lets them. {-1, 1} where they do so on the whole edge. Pieces are halved, the worst
/// first (Piessens et al., QUADPACK, 1983), while both halves integrate to something else, or while the range says that
/// f goes beyond its samples by more than they differ and a 256th of the scale: so what lies between the samples is
/// found however narrow it is. Without a range f is looked at in 64 points first. A jump ends up in a piece of 2^-30 of
/// the edge; no edge has more than 4096.
std::vector<double> resolving_cuts(const LineFunction& f);

/// The places at which resolving_cuts cuts an edge; may be empty.
using EdgeCuts = std::function<std::vector<double>(const Edge&)>;

/// The union of both, each ascending from -1 to 1.
std::vector<double> merged(const std::vector<double>& a, const std::vector<double>& b);

/// The points of a rule on each of the pieces between cuts, as one rule on [-1, 1].
LineRule cut_rule(const std::vector<double>& cuts, int gauss_points);

/// Sides of a boundary, and where their edges are cut; empty `cuts`: nowhere.
struct CutSides {
  const std::vector<CellSide>& sides;
  EdgeCuts cuts;

  /// Four Gauss points on each piece of an edge.
  LineRule rule(const Edge& edge) const;

  /// Calls visit(edge, point, shape, dA) at each of these, dA with the depth.
  template <typename Visit>
  void for_each_point(const Mesh& mesh, const Model& model, const Visit& visit) const {
    for (const CellSide& at : sides) {
      const Edge edge = side_edge(mesh.cells[at.cell], at.side);
      const LineRule points = rule(edge);
      for (std::size_t q = 0; q < points.points.size(); ++q) {
        const EdgePoint p = edge_point(mesh.nodes, edge, points.points[q]);
        const double dA = points.weights[q] * p.jacobian() * model.depth(p.position.x());
        visit(edge, p, edge_shape(edge.node_count, points.points[q]), dA);
      }
    }
  }
};

/// f less the polynomial that stands for it in the mean.
struct LineMisfit {
  double mean = 0;       ///< of |f - polynomial| over the edge
  double largest = 0;    ///< of the same
  double mean_of_f = 0;  ///< of |f|
  double at = 0;         ///< xi of the largest difference
  double finest = 2;     ///< length in xi of the shortest piece on which f changes by a tenth of what it does
};

/// Of a function cut by resolving_cuts: the polynomial is the projection of f on those of degree 2 in L2.
LineMisfit misfit(const LineFunction& f, const std::vector<double>& cuts);

}  // namespace mortise
