#include "fem/quadrature.hpp"

#include <cmath>
#include <numbers>

namespace mortise {

LineRule gauss_legendre(int n) {
  LineRule rule;
  for (int i = n; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));  // Tricomi's start, then Newton on P_n
    double slope = 0;
    for (int step = 0; step < 20; ++step) {
      double p = 1, previous = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = n * (x * p - previous) / (x * x - 1);
      const double change = p / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    rule.points.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

CellRule product_rule(CellKind kind, int n) {
  const LineRule line = gauss_legendre(n);
  CellRule rule;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    for (std::size_t j = 0; j < line.points.size(); ++j) {
      const double x = line.points[i], y = line.points[j], w = line.weights[i] * line.weights[j];
      if (corner_count(kind) == 4) {
        rule.points.emplace_back(x, y);
        rule.weights.push_back(w);
      } else {  // (a, b) in the unit square -> (a, (1 - a) b)
        const double a = (1 + x) / 2, b = (1 + y) / 2;
        rule.points.emplace_back(a, (1 - a) * b);
        rule.weights.push_back(w * (1 - a) / 4);
      }
    }
  return rule;
}

CellRule cell_rule(CellKind kind) {
  switch (kind) {
    case CellKind::tri3:
      return {{{1. / 3, 1. / 3}}, {0.5}};
    case CellKind::tri6:
      return {{{1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}, {1. / 6, 1. / 6, 1. / 6}};
    case CellKind::quad4:
      return product_rule(kind, 2);
    case CellKind::quad8:
    case CellKind::quad9:
      return product_rule(kind, 3);
  }
  throw std::logic_error("cell_rule: unknown cell kind");
}

CellRule stress_points(CellKind kind) {
  switch (kind) {
    case CellKind::tri3:
    case CellKind::tri6:
      return cell_rule(kind);
    case CellKind::quad4:
      return product_rule(kind, 1);
    case CellKind::quad8:
    case CellKind::quad9:
      return product_rule(kind, 2);
  }
  throw std::logic_error("stress_points: unknown cell kind");
}

}  // namespace mortise
