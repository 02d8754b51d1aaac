// [materials.NAME]
#include <algorithm>
#include <numbers>

#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

void read_orthotropic(const Node& node, Material& material) {
  const Node& young = *find(node, "young");
  const auto e = number_triple(young, "a number, or a list of three, [E1, E2, E3]");
  for (const Node& modulus : young.items) above(0).read(modulus);
  const std::string ratios = "a list of three, [nu12, nu13, nu23], as 'young' is one";
  const auto nu = number_triple(require(node, "poisson", ratios), ratios);
  OrthotropicModuli m{.e1 = e[0], .e2 = e[1], .e3 = e[2], .nu12 = nu[0], .nu13 = nu[1], .nu23 = nu[2]};
  m.g12 = above(0).read(require(node, "shear", "the modulus G12, a number > 0"));
  if (const Node* angle = find(node, "angle")) m.angle = number(*angle) * std::numbers::pi / 180;
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

// Above 0; 0 in a material that has none.
Kind<double> a_density() {
  Kind<double> kind = above(0);
  kind.trouble = [of_given = kind.trouble](const double& density) { return density == 0 ? "" : of_given(density); };
  return kind;
}

// The rows of `material` that go with a key.
Keys rows_of(Material& material, const std::vector<std::string>& names) {
  Keys rows = material_keys(material);
  std::erase_if(rows, [&](const Key& key) { return !std::ranges::count(names, key.name); });
  return rows;
}

}  // namespace

Keys isotropic_keys(Material& material) {
  return {
      required(key("young", material.young, above(0), ""), "Young's modulus, a number > 0"),
      required(key("poisson", material.poisson, between(-1, 0.5), ""), "Poisson's ratio, a number between -1 and 0.5"),
  };
}

Keys material_keys(Material& material) {
  const Keys isotropic = isotropic_keys(material);
  const Json three = list_of(a_number().schema, 3, 3);
  return {
      {"young", either(isotropic[0].schema, list_of(above(0).schema, 3, 3)),
       "Young's modulus > 0; of an orthotropic material `[E1, E2, E3]`", "required, or `stiffness`"},
      {"poisson", either(isotropic[1].schema, three),
       "Poisson's ratio, above −1 and below 0.5; of an orthotropic material `[nu12, nu13, nu23]`, `nu_ij` = −ε_j / ε_i "
       "under a stress along i",
       "required with `young`"},
      {"shear", above(0).schema, "`G12` of an orthotropic material", "required with three of `young`"},
      {"angle", a_number().schema, "from x to direction 1 of an orthotropic material, degrees counter-clockwise", "0"},
      {"stiffness", list_of(list_of(a_number().schema, 4, 4), 4, 4),
       "symmetric, 4 x 4, for (ε_xx, ε_yy, ε_zz, γ_xy): in place of the moduli"},
      key("thermal_expansion", material.thermal_expansion, a_number(), "per degree, alike in all directions",
          "required by a temperature"),
      key("density", material.density, a_density(), "mass per volume, > 0", "required by gravity"),
  };
}

Material read_material(const Node& node) {
  Material material;
  const Node *young = find(node, "young"), *stiffness = find(node, "stiffness");
  const std::vector<std::string> any{"thermal_expansion", "density"};
  const auto with = [&](std::vector<std::string> names) {
    names.insert(names.end(), any.begin(), any.end());
    return rows_of(material, names);
  };
  if (stiffness != nullptr) {
    read(node, with({"stiffness"}));
    read_stiffness(*stiffness, material);
  } else if (young != nullptr && young->kind == Node::Kind::list) {
    read(node, with({"young", "poisson", "shear", "angle"}));
    read_orthotropic(node, material);
  } else {
    Keys keys = isotropic_keys(material);
    for (const Key& key : with({"stiffness"})) keys.push_back(key);
    read(node, keys);
  }
  return material;
}

}  // namespace mortise::scene_file
