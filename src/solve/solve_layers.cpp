#include "solve/solve_layers.hpp"

#include "solve/layered_system.hpp"

namespace mortise {
namespace {

constexpr int max_steps = 100, halvings = 50;
constexpr double tolerance = 1e-8;  // of the largest p, which is not known any better

// Of each compression its law's given overlap, the last one of a table.
VecX given_overlaps(const SurfaceLayers& layers) {
  VecX d = layers.weight;
  int i = 0;
  for (const auto& [law, end] : layers.laws)
    for (; i < end; ++i) d(i) = law.points.back().x();
  return d;
}

VecX with_pressures(const SurfaceLayers& layers, VecX p) {
  int i = 0;
  for (const auto& [law, end] : layers.laws)
    for (; i < end; ++i) p(i) = law.overlap(p(i));
  return p;
}

// How much of the step (u, d) lowers the energy for sure: as far as a bound of its slope is negative that is free of
// round-off, the slope of the tangents' energy, -(1 - t) curvature at most, and what the laws' forces are above theirs.
double part_of_step(const SaddlePointSystem& s, const VecX& stiffness, const VecX& d, const VecX& step) {
  const Eigen::Index n = s.f.size();
  const VecX u = step.head(n), change = step.segment(n, d.size()), forces = layer_forces(s.layers, d),
             grow = stiffness.cwiseProduct(change);
  const double curvature = u.dot(s.K.selfadjointView<Eigen::Lower>() * u) + change.dot(grow);
  const auto slope = [&](double t) {
    return (t - 1) * curvature + change.dot(layer_forces(s.layers, d + t * change) - forces - t * grow);
  };
  double low = 0, high = 1;
  if (slope(high) <= 0) return high;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (slope(middle) <= 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

Solution solve_layers(const SaddlePointSystem& s, const std::function<Solution(SaddlePointSystem)>& solve) {
  const SurfaceLayers& layers = s.layers;
  const Eigen::Index n = s.f.size(), l = layers.B.cols();
  VecX x, d = VecX::Zero(l), forces = d, stiffness = layer_stiffness(layers, given_overlaps(layers));
  Solution found;
  for (int step = 0; step < max_steps; ++step) {
    SaddlePointSystem tangent = layered_system(s, stiffness);
    tangent.f.segment(n, l) = stiffness.cwiseProduct(d) - forces;
    if (step > 0) tangent.start = found.active;
    found = solve(std::move(tangent));
    found.layer_steps = step + 1;
    if (found.status != SolveStatus::converged) return found;
    const VecX to = found.u.segment(n, l), pressed = forces + stiffness.cwiseProduct(to - d), last = d;
    if (largest_entry((layer_forces(layers, to) - pressed).cwiseQuotient(layers.weight)) <=
        tolerance * largest_entry(pressed.cwiseQuotient(layers.weight)))
      return found;
    if (step > 0) x = step == 1 ? found.u : VecX(x + part_of_step(s, stiffness, d, found.u - x) * (found.u - x));
    d = step == 0 ? with_pressures(layers, pressed.cwiseQuotient(layers.weight)) : VecX(x.segment(n, l));
    forces = layer_forces(layers, d);
    stiffness = layer_stiffness(layers, d.cwiseAbs().cwiseMax(largest_entry(d - last)));
  }
  found.status = SolveStatus::not_converged;
  return found;
}

}  // namespace mortise
