// What else than p along the lines an accuracy can be asked of, as functionals of the solution.
#pragma once

#include "error/line_part.hpp"
#include "error/pressure_estimate.hpp"
#include "fem/locate.hpp"
#include "fem/patch_recovery.hpp"
#include "model/method.hpp"
#include "problem/problem.hpp"
#include "solve/solution.hpp"

namespace mortise {

/// By which estimates are multiplied.
inline constexpr double error_safety = 1.5;

/// A column a component: loads^T u - rows^T lambda. No columns where no functional is asked for.
struct GoalFunctionals {
  MatX rows;   ///< m x components: of the mean (1), of the force on the multiplier side's body (2)
  MatX loads;  ///< n x components: of a displacement (2), of a stress (11, 22, 12), as of stress_loads
  std::optional<CellPlace> place;  ///< of a displacement or a stress
  /// At each contact point of the pair by how much the dual solutions are to open it: points x components.
  MatX opening;
};

/// `line`: of spec.pair. Throws SceneError where spec.at lies in no body or, none being named, in several.
GoalFunctionals goal_functionals(const Mesh& mesh, const Discretisation& discretisation, const ContactPair& pair,
                                 const PressureLine& line, const AccuracySpec& spec);

/// n x 2: of u at a place.
MatX displacement_loads(const Mesh& mesh, const CellPlace& place);

/// n x 3: of the stress (11, 22, 12) there, as the linear function that fits it best in the cells around has it,
/// initial strains left out. Their mean would be blind to bending where they are a slender body's whole thickness.
MatX stress_loads(const Mesh& mesh, const Discretisation& discretisation, const CellPlace& place);

/// Where stresses have no limit at a place, x, the exponent by which displacements grow with the distance from it: at a
/// corner of its body, or where contact has a singular point (1: stresses grow as a logarithm) or p goes as a small
/// power without limit. None elsewhere.
std::optional<double> singular_exponent(const Surroundings& around, const std::vector<PressureEstimate>& pressures,
                                        const CellPlace& place, const Vec2& x);

/// Throws SceneError where a stress has no limit at spec.at.
void require_stress(const Surroundings& around, const std::vector<PressureEstimate>& pressures,
                    const GoalFunctionals& functionals, const AccuracySpec& spec);

/// 11, 22, 12: the stress recovered at the place less the elements' own. `patches`: u in its first field.
Eigen::Vector3d stress_difference(const Problem& problem, const VecX& u, const StressPatches& patches,
                                  const CellPlace& place);

/// In the axes of `turn`, of each component the larger of that difference at the place and its root mean square over
/// the cell: where the elements' own stresses cross the recovered ones both err.
Eigen::Vector3d cell_stress_error(const Problem& problem, const VecX& u, const StressPatches& patches,
                                  const CellPlace& place, const Eigen::Matrix3d& turn);

/// By how much that error of a cell's stresses moves a place in it, length: the stresses of a unit force there are
/// about 1 / (2 pi r) (Kelvin), which no dual on this mesh shows within the cell. Over a disc of its area their product
/// with the strains is at most the disc's radius times these.
double cell_displacement_error(const Problem& problem, int cell, const Eigen::Vector3d& stress);

/// The values, and what they may be off by.
struct GoalEstimate {
  VecX value;        ///< of each component; of a stress the recovered one at the place
  MatX parts;        ///< cells x components: of each cell in the error, its sign as it came
  VecX cells;        ///< of each component what these make it off by
  VecX besides;      ///< what is added: of the bodies' corners (error/corner_tails.hpp), of data, of the place
  double local = 0;  ///< of a mean of p: mean of its local error
  std::vector<LinePart> lines = {};  ///< of each pair: what the error of p does to each component
  double far() const { return (cells + besides).norm(); }
  double line() const;                                                                     ///< of all pairs
  double error() const { return error_safety * (far() + line() + local) / value.norm(); }  ///< relative
};

/// `parts`: cells x components, of the functionals' duals (ErrorProducts).
GoalEstimate goal_estimate(const GoalFunctionals& functionals, const Solution& solution, MatX parts);

/// The cell that has the place has a larger part, by what its own stresses may move the place.
void add_displacement_error(const Problem& problem, const GoalFunctionals& functionals, const VecX& u,
                            GoalEstimate& goal);

/// The value of a stress becomes the recovered one; by what the elements' own differs from it there, the cell that has
/// the place has a larger part. Where p falls to zero as a small power, it is off by what is left to fall.
void add_stress_error(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                      const GoalFunctionals& functionals, const VecX& u, GoalEstimate& goal);

/// Why a window of a mean is none: reversed, or nowhere on the line. Empty where it is one.
std::string window_trouble(const PressureLine& line, const Vec2& window);

/// Mean of the errors at the vertices of the edges that have a part in the window of spec.
double mean_error(const Mesh& mesh, const Model& model, const ContactPair& pair, const PressureLine& line,
                  const VecX& errors, const Vec2& window);

}  // namespace mortise
