#include "solve/contact_factor.hpp"

#include "solve/bordered_system.hpp"
#include "solve/layered_system.hpp"
#include "solve/multipoint_system.hpp"

namespace mortise {

DirectFactor::DirectFactor(const SaddlePointSystem& system, std::shared_ptr<FactoredBodies> bodies,
                           MultiplierSystem multipliers)
    : row_scale_(system.row_scale),
      stiffness_scale_(system.stiffness_scale),
      unknowns_(system.K.cols()),
      springs_(system.grounded.size()),
      bodies_(std::move(bodies)),
      multipliers_(std::move(multipliers)) {}

DirectFactor::Border DirectFactor::border(const MatX& functionals, const MatX& loads) const {
  const auto& [free, factor] = *bodies_;
  const Eigen::Index rows = functionals.rows(), count = functionals.cols(), loaded = loads.cols(),
                     without_load = count - loaded;
  Border found{.multipliers = MatX(rows + springs_, count), .y = MatX(factor.size(), loaded)};
  for (Eigen::Index k = 0; k < count; ++k) {
    VecX rhs = VecX::Zero(rows + springs_);
    if (k >= without_load) {
      const VecX load = loads.col(k - without_load);
      found.y.col(k - without_load) = factor.forward(load(free) / stiffness_scale_);
      rhs = factor.at_border(found.y.col(k - without_load));
    }
    rhs.head(rows) -= functionals.col(k).cwiseQuotient(row_scale_);
    found.multipliers.col(k) = multipliers_.solve(rhs);
  }
  return found;
}

MatX DirectFactor::in_units(const MatX& multipliers) const {
  return (stiffness_scale_ * row_scale_.cwiseInverse()).asDiagonal() * multipliers.topRows(row_scale_.size());
}

MatX DirectFactor::multipliers(const MatX& functionals, const MatX& loads) const {
  return in_units(border(functionals, loads).multipliers);
}

DualAnswers DirectFactor::answers(const MatX& functionals, const MatX& loads) const {
  auto& [free, factor] = *bodies_;
  const Eigen::Index loaded = loads.cols(), without_load = functionals.cols() - loaded;
  const auto [multipliers, y] = border(functionals, loads);
  DualAnswers found{.z = MatX::Zero(unknowns_, functionals.cols()), .mu = in_units(multipliers)};
  if (without_load > 0)
    found.z.leftCols(without_load)(free, Eigen::all) = factor.at_rows(multipliers.leftCols(without_load));
  if (loaded > 0) found.z.rightCols(loaded)(free, Eigen::all) = factor.backward(y, multipliers.rightCols(loaded));
  return found;
}

DualAnswers MultipointFactor::answers(const MatX& functionals, const MatX& loads) const {
  DualAnswers found = of_q_->answers(functionals, loads_of_q(loads));
  found.z = T_ * found.z;
  return found;
}

MatX MultipointFactor::multipliers(const MatX& functionals, const MatX& loads) const {
  return of_q_->multipliers(functionals, loads_of_q(loads));
}

std::shared_ptr<const ContactFactor> factorise_contact(const SaddlePointSystem& s, const std::vector<char>& closed,
                                                       const VecX& compression) {
  if (const auto& multipoint = s.constraints.multipoint)
    return std::make_shared<MultipointFactor>(multipoint->T,
                                              factorise_contact(independent_system(s), closed, compression));
  if (!s.layers.laws.empty()) {
    const SaddlePointSystem layered = layered_system(s, layer_stiffness(s.layers, compression));
    return std::make_shared<MultipointFactor>(without_layers(s.f.size(), layered.f.size()),
                                              factorise_contact(layered, closed));
  }
  BorderedSystem reduced = bordered_system(s);
  SplitCholesky factor(std::move(reduced.matrix), reduced.blocks);
  std::vector<int> rows;
  for (int a = 0; a < int(closed.size()); ++a)
    if (closed[a]) rows.push_back(a);
  MultiplierSystem multipliers(factor.take_border_compliance(), Eigen::Index(s.grounded.size()), std::move(rows));
  return std::make_shared<DirectFactor>(s, std::make_shared<FactoredBodies>(std::move(reduced.free), std::move(factor)),
                                        std::move(multipliers));
}

std::shared_ptr<const ContactFactor> exact_factor(const SaddlePointSystem& system, const Solution& solution) {
  const bool is_exact = solution.solver == Solver::direct && system.layers.are_linear();
  return is_exact && solution.factor ? solution.factor
                                     : factorise_contact(system, solution.active, solution.compression);
}

std::shared_ptr<const ContactFactor> contact_factor(const SaddlePointSystem& system, const Solution& solution) {
  return solution.factor ? solution.factor : factorise_contact(system, solution.active, solution.compression);
}

}  // namespace mortise
