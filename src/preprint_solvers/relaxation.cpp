#include "preprint_solvers/relaxation.hpp"

#include <Eigen/QR>

#include "solve/iteration_monitor.hpp"

namespace mortise {
namespace {

// The corrections so far and where they were found.
struct Past {
  std::vector<VecX> x, z;
};

double aitken(double beta, const Past& past, const VecX& z) {
  if (past.z.empty()) return beta;
  const VecX change = z - past.z.back();
  const double size = change.squaredNorm();
  return size > 0 ? -beta * past.z.back().dot(change) / size : beta;
}

// x + beta z after the combination of past differences that makes z least.
VecX anderson(double beta, const Past& past, const VecX& x, const VecX& z) {
  // newest difference first; one that the newer ones span is left out
  std::vector<VecX> basis;
  VecX best_x = x, best_z = z;
  std::vector<VecX> moves;
  for (std::size_t k = past.z.size(); k-- > 0;) {
    VecX dz = z - past.z[k], dx = x - past.x[k];
    const double size = dz.norm();
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t i = 0; i < basis.size(); ++i) {
        const double along = basis[i].dot(dz);
        dz -= along * basis[i];
        dx -= along * moves[i];
      }
    const double left = dz.norm();
    if (!(left > 1e-10 * size)) continue;
    basis.push_back(dz / left);
    moves.push_back(dx / left);
    const double along = basis.back().dot(best_z);
    best_z -= along * basis.back();
    best_x -= along * moves.back();
  }
  return best_x + beta * best_z;
}

// z(x) = z_0 - A (x - x_0): the directions p, orthogonal in A p, are those of the residuals.
VecX krylov(const Correction& correction, const Measure& measure, VecX x, IterationMonitor& monitor) {
  VecX z = correction(x);
  std::vector<VecX> directions, images;
  while (monitor.go_on(measure(x, z), z.norm())) {
    VecX p = z, Ap = z - correction(x + z);
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t i = 0; i < images.size(); ++i) {
        const double along = images[i].dot(Ap);
        Ap -= along * images[i];
        p -= along * directions[i];
      }
    const double size = Ap.norm();
    if (!(size > 0)) break;  // the iteration has the solution, or z is not what it says
    directions.push_back(p / size);
    images.push_back(Ap / size);
    const double length = images.back().dot(z);
    x += length * directions.back();
    z -= length * images.back();
    monitor.took(1);
  }
  return x;
}

// By aitken or anderson, or with beta as it stands.
VecX relaxed(const Correction& correction, const Measure& measure, VecX x, const RelaxationOptions& options,
             IterationMonitor& monitor) {
  Past past;
  double beta = options.beta;
  VecX z = correction(x);
  while (monitor.go_on(measure(x, z), z.norm())) {
    if (options.acceleration == Acceleration::aitken) beta = aitken(beta, past, z);
    VecX next = options.acceleration == Acceleration::anderson ? anderson(beta, past, x, z) : VecX(x + beta * z);
    past.x.push_back(std::move(x));
    past.z.push_back(std::move(z));
    x = std::move(next);
    z = correction(x);
    monitor.took(beta);
  }
  return x;
}

}  // namespace

RelaxationResult relax(const Correction& correction, const Measure& measure, VecX x, const RelaxationOptions& options) {
  IterationMonitor monitor(options.tolerance, options.max_iterations - 1);  // z is evaluated before the first step too
  x = options.acceleration == Acceleration::krylov ? krylov(correction, measure, std::move(x), monitor)
                                                   : relaxed(correction, measure, std::move(x), options, monitor);
  return {monitor.status(), std::move(x), monitor.history(), monitor.convergence_rate()};
}

}  // namespace mortise
