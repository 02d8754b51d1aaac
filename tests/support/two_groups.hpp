// Two bodies as random matrices, small enough for dense algebra: what domain decomposition works on.
#pragma once

#include <random>

#include "solve/saddle_point_system.hpp"

namespace mortise::test {

/// Unknowns 0 ... n - 1 are the first body's, n ... 2 n - 1 the second's; each couples all of its unknowns. Rows of B
/// take unknowns of both. The second body may float: its stiffness has the rigid motion (1, 1, ..., 1), which a spring
/// at its first unknown holds.
struct TwoGroups {
  int n = 12, m = 4;
  bool floats = false;
  SaddlePointSystem system;
  std::vector<char> first, second;  ///< 2 n: whose unknown

  MatX K() const { return MatX(system.K).selfadjointView<Eigen::Lower>(); }
};

inline TwoGroups two_groups(bool floats, unsigned seed = 17) {
  TwoGroups g;
  g.floats = floats;
  const int n = g.n, m = g.m;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0.1, 1);
  MatX K = MatX::Zero(2 * n, 2 * n);
  for (int body = 0; body < 2; ++body)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j) {  // a spring between each two unknowns
        const int a = body * n + i, b = body * n + j;
        const double k = value(random);
        K(a, a) += k;
        K(b, b) += k;
        K(a, b) -= k;
        K(b, a) -= k;
      }
  for (int i = 0; i < (floats ? n : 2 * n); ++i) K(i, i) += 1;  // held
  SaddlePointSystem& s = g.system;
  s.K = MatX(K.triangularView<Eigen::Lower>()).sparseView();
  const auto draw = [&] { return value(random); };
  s.f = VecX::NullaryExpr(2 * n, draw);
  s.constraints = {std::vector<char>(2 * n, 0), VecX::Zero(2 * n)};
  s.stiffness_scale = 3;
  s.B = MatX(MatX::NullaryExpr(m, 2 * n, draw)).sparseView();
  s.g = VecX::NullaryExpr(m, draw);
  s.row_scale = VecX::LinSpaced(m, 1, 2);
  if (floats) s.grounded = {n};
  g.first.assign(2 * n, 0);
  std::fill(g.first.begin(), g.first.begin() + n, 1);
  g.second.assign(2 * n, 1);
  std::fill(g.second.begin(), g.second.begin() + n, 0);
  return g;
}

}  // namespace mortise::test
