// [materials.NAME]
#include <algorithm>
#include <numbers>

#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

void read_isotropic(const Node& node, Material& material) {
  material.young = positive_number(require(node, "young", "Young's modulus, a number > 0"));
  const Node& poisson = require(node, "poisson", "Poisson's ratio, a number between -1 and 0.5");
  material.poisson = number(poisson);
  if (material.poisson <= -1 || material.poisson >= 0.5)
    fail(poisson, "expected a number between -1 and 0.5 (both excluded), found " + describe(poisson));
}

void read_orthotropic(const Node& node, Material& material) {
  const Node& young = *find(node, "young");
  const auto e = number_triple(young, "a number, or a list of three, [E1, E2, E3]");
  for (const Node& modulus : young.items) positive_number(modulus);
  const std::string ratios = "a list of three, [nu12, nu13, nu23], as 'young' is one";
  const auto nu = number_triple(require(node, "poisson", ratios), ratios);
  const Node* angle = find(node, "angle");
  OrthotropicModuli m{.e1 = e[0], .e2 = e[1], .e3 = e[2], .nu12 = nu[0], .nu13 = nu[1], .nu23 = nu[2]};
  m.g12 = positive_number(require(node, "shear", "the modulus G12, a number > 0"));
  if (angle != nullptr) m.angle = number(*angle) * std::numbers::pi / 180;
  material.young = std::ranges::max(e);
  material.stiffness = orthotropic_stiffness(m);
  if (!material.stiffness)
    fail(*find(node, "poisson"),
         "found ratios that with 'young' give some strains a negative energy; expected nu_ij^2 "
         "below E_i / E_j, and 1 above nu12 nu21 + nu23 nu32 + nu31 nu13 + 2 nu21 nu32 nu13");
  material.moduli = m;
}

void read_stiffness(const Node& stiffness, Material& material) {
  const std::string expected = "a symmetric matrix, a list of four rows of four (11, 22, 33, 12)";
  if (stiffness.kind != Node::Kind::list || stiffness.items.size() != 4) fail_expected(stiffness, expected);
  Mat4 C;
  for (int i = 0; i < 4; ++i) {
    const Node& row = stiffness.items[i];
    if (row.kind != Node::Kind::list || row.items.size() != 4) fail_expected(row, "a row of four numbers");
    for (int j = 0; j < 4; ++j) C(i, j) = number(row.items[j]);
  }
  if ((C - C.transpose()).cwiseAbs().maxCoeff() > 1e-9 * C.cwiseAbs().maxCoeff()) fail_expected(stiffness, expected);
  if (!is_stiffness(C)) fail(stiffness, "gives some strains no positive energy; expected a positive definite matrix");
  material.stiffness = C;
  material.young = C.diagonal().maxCoeff();
}

}  // namespace

Material read_material(const Node& node) {
  Material material;
  const Node *young = find(node, "young"), *stiffness = find(node, "stiffness");
  if (stiffness != nullptr) {
    expect_keys(node, {"stiffness", "thermal_expansion", "density"});
    read_stiffness(*stiffness, material);
  } else if (young != nullptr && young->kind == Node::Kind::list) {
    expect_keys(node, {"young", "poisson", "shear", "angle", "thermal_expansion", "density"});
    read_orthotropic(node, material);
  } else {
    expect_keys(node, {"young", "poisson", "stiffness", "thermal_expansion", "density"});
    read_isotropic(node, material);
  }
  if (const Node* expansion = find(node, "thermal_expansion")) material.thermal_expansion = number(*expansion);
  if (const Node* density = find(node, "density")) material.density = positive_number(*density);
  return material;
}

}  // namespace mortise::scene_file
