// Results of a contact pair at its nodes and element centres.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "fem/stress.hpp"
#include "model/resultant.hpp"
#include "results/contact_nodes.hpp"

namespace mortise {

struct FittedPressure;

/// One node of either curve. Lengths and stresses in the scene's units; NaN where a node faces nothing.
struct ContactNode {
  int node;
  double s;                    ///< arc length, undeformed
  Vec2 position;               ///< undeformed
  Vec2 normal;                 ///< of the multiplier side there
  double u_n;                  ///< displacement along `normal`
  double p;                    ///< contact pressure (p* where errors are estimated and it is credible); on the opposite
                               ///< side the projected one
  double gap;                  ///< deformed, along `normal`; the undeformed gap is zero in a `closed` pair
  double sigma_n;              ///< normal stress recovered in the node's own body (preprint eq. 26)
  double sigma_2;              ///< stress 22 there
  Place on_multiplier{-1, 0};  ///< on the multiplier side, where p is taken; edge -1: it faces nothing
  double p_error = std::numeric_limits<double>::quiet_NaN();       ///< bar of p, stress; NaN where there is none
  double p_multiplier = std::numeric_limits<double>::quiet_NaN();  ///< the multiplier's own pressure
  double p_fluid = 0;                                              ///< what of p is the fluid's
};

/// The centre of an element along the curve; s, position and normal at the middle of its edge.
struct ContactCentre {
  double s;
  Vec2 position;
  /// Mean over the edge, of which what faces nothing has none: all of them carry the pair's force. On 3-node triangles
  /// better than at the nodes, where it zigzags.
  double p;
  double sigma_n, sigma_2;
};

/// What the fluid of a pair does.
struct FluidResults {
  Vec2 force = Vec2::Zero();  ///< its part of ContactResults::force
  double wet_length = 0;      ///< of the multiplier side where it faces the other
  /// On the opposite side, besides what balances `force`: there it presses along that side's own normals.
  Resultant besides{};
};

struct ContactSide {
  std::string curve;                   ///< name
  std::vector<ContactNode> nodes;      ///< by s
  std::vector<ContactCentre> centres;  ///< by s
};

struct ContactResults {
  ContactSide multiplier, opposite;
  VecX pressure;                              ///< one a multiplier (Coupling::node)
  double length = 0;                          ///< of the multiplier side
  double length_in_contact = 0;               ///< as length_in_contact() says
  std::optional<std::array<double, 2>> ends;  ///< s at which contact begins and ends, the same
  Vec2 force = Vec2::Zero();                  ///< of the contact on the multiplier side's body, times depth
  double moment = 0;                          ///< of the same about the origin
  Vec2 centre = Vec2::Zero();                 ///< of the multiplier side, mean place along its length
  /// Where errors are estimated: what the force and its moment about `centre`, and the length in contact may be off by.
  std::optional<Eigen::Vector3d> force_error;
  std::optional<double> length_error;
  std::optional<FluidResults> fluid;
  bool gives_way = false;       ///< by a layer: p is bounded where the other side ends
  double p_min = 0, p_max = 0;  ///< at nodes_of_extremes()
  double p_mean = 0;            ///< over what faces the other side
  double p_least = 0;           ///< the smallest between the nodes too, where the sides face each other
};

/// Of the multiplier side those that face the other or carry pressure. Where contact gives way those of the other side
/// too: p may be largest where that ends, between nodes of the first.
std::vector<const ContactNode*> nodes_of_extremes(const ContactResults& results);

/// s runs along both curves from the end of the multiplier side with the smaller x (then y).
/// `pair`: one of the problem's, with its nodes; `displacement`: the solution's largest.
ContactResults contact_results(const Problem& problem, const ContactPair& pair, const ContactNodes& nodes,
                               const StressField& stress, const Solution& solution, double displacement);

/// The N of names as contact.N.force.x: places of the problem's pairs and of its ties among both, in the order of the
/// scene's entries. A pair keeps it where another is tied.
struct ContactNumbers {
  std::vector<int> pairs, ties;
};

ContactNumbers contact_numbers(const Problem& problem);

/// p* (error/pressure_form.hpp) into the nodes and the extremes of p. The multiplier's p stays at the centres and
/// where p* is not known.
void set_fitted_pressure(const Points& nodes, const Curve& multiplier, const FittedPressure& fitted,
                         ContactResults& results);

}  // namespace mortise
