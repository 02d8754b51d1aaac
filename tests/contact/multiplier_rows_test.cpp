// Which multipliers are unknowns of their own: each reason why one is not, by itself.
#include "contact/multiplier_rows.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

// Flat plates that match, six edges of two nodes on both sides, and multipliers 0 ... 6 at the lower side's nodes.
struct Rows {
  Mesh mesh = test::mesh_of({.n_upper = 6, .n_lower = 6, .kind_upper = CellKind::quad4, .kind_lower = CellKind::quad4});
  Curve multiplier = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
  Curve opposite = contact_curve(mesh, boundary_index(mesh, "upper_contact"));
  Constraints constraints = no_constraints(mesh);
  std::vector<int> nodes = curve_nodes(multiplier);
  double h = 0.8 / 6;
  Support support{.extent = VecX::Constant(7, h),
                  .scale = VecX::Constant(7, h),
                  .weight = VecX::Constant(7, h),
                  .lagrange = VecX::Constant(7, h),
                  .faced = VecX::Constant(7, 2 * h)};
  Coupling coupling;

  Rows() {
    coupling.node = nodes;
    for (int e = 0; e < 6; ++e) coupling.on_edge.push_back({e, e + 1, -1});
  }

  // Prescribes the vertical displacements of both sides at multiplier k.
  void prescribe(int k, double below, double above) {
    const auto set = [&](int node, double value) {
      constraints.fixed[2 * node + 1] = 1;
      constraints.value(2 * node + 1) = value;
    };
    set(nodes[k], below);
    for (const int node : curve_nodes(opposite))
      if ((mesh.nodes.row(node) - mesh.nodes.row(nodes[k])).norm() < 1e-12) set(node, above);
  }

  std::vector<int> numbered() {
    const ContactInterface interface {
      multiplier, opposite, {}, {}, {}
    };
    number_rows({mesh, interface, constraints, InitialGap::measured}, support, coupling);
    return coupling.row;
  }
};

TEST(MultiplierRows, OneEachAlongTheCurve) {
  Rows r;
  EXPECT_EQ(r.numbered(), (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(r.coupling.gap0.size(), 7);
  EXPECT_EQ(r.coupling.scale.size(), 7);
  EXPECT_TRUE(r.coupling.dropped.empty());
}

// Dual functions of a quadratic edge on the axis of rings: psi is zero, as int N r ds is.
TEST(MultiplierRows, OneWhosePsiVanishesSharesTheNextOnes) {
  Rows r;
  r.support.scale(0) = r.support.weight(0) = 0;
  EXPECT_EQ(r.numbered(), (std::vector<int>{0, 0, 1, 2, 3, 4, 5}));
}

TEST(MultiplierRows, WhatFacesNothingHasNone) {
  Rows r;
  r.support.extent(0) = r.support.extent(4) = 0;
  EXPECT_EQ(r.numbered(), (std::vector<int>{-1, 0, 1, 2, -1, 3, 4}));
  ASSERT_EQ(r.coupling.dropped.size(), 2u);
  EXPECT_EQ(r.coupling.node[r.coupling.dropped[1].multiplier], r.nodes[4]);
  EXPECT_EQ(r.coupling.dropped[1].reason, "");
}

TEST(MultiplierRows, WhatWeighsNothingSharesTheNearest) {
  Rows r;
  r.support.weight(6) = 0.04 * r.h;
  EXPECT_EQ(r.numbered(), (std::vector<int>{0, 1, 2, 3, 4, 5, 5}));
  EXPECT_EQ(r.coupling.gap0.size(), 6);
}

TEST(MultiplierRows, WhatHardlyFacesSharesTheNearest) {
  Rows r;
  r.support.faced(0) = 0.05 * r.h;                                   // of an edge of h
  r.support.faced(3) = 0.1 * r.h;                                    // of two
  EXPECT_EQ(r.numbered(), (std::vector<int>{0, 0, 1, 2, 2, 3, 4}));  // of two as near the one after
}

TEST(MultiplierRows, WhereAllHardlyFaceAllAreFree) {
  Rows r;
  r.support.faced.setConstant(0.01 * r.h);
  EXPECT_EQ(r.numbered(), (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(MultiplierRows, WhereBothSidesArePrescribedTheNearestDecides) {
  Rows r;
  r.prescribe(0, 1e-3, 1e-3);
  r.prescribe(6, 0, 1e-3);  // and stay apart
  EXPECT_EQ(r.numbered(), (std::vector<int>{0, 0, 1, 2, 3, 4, -1}));
  EXPECT_EQ(r.coupling.dropped[1].reason,
            "with normal displacement prescribed on both sides, which stay apart: pressure zero");
}

TEST(MultiplierRows, PrescribedOverlapsAndNothingFreeAreErrors) {
  Rows overlap;
  overlap.prescribe(2, 1e-3, 0);
  EXPECT_THROW(overlap.numbered(), InputError);
  Rows all;
  for (int k = 0; k < 7; ++k) all.prescribe(k, 0, 0);
  EXPECT_THROW(all.numbered(), InputError);
}

}  // namespace
}  // namespace mortise
