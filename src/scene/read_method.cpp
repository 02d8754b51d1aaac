// [method]
#include <algorithm>
#include <cmath>

#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

// A number > 0, or "auto", which is the same as no entry.
std::optional<double> read_beta(const Node* node) {
  if (node == nullptr || (node->kind == Node::Kind::string && node->text == "auto")) return std::nullopt;
  return positive_number(*node);
}

int read_count(const Node& node) {
  const double value = positive_number(node);
  if (value != std::floor(value) || value > 1e6)
    fail(node, "expected a whole number from 1 to 1000000, found " + describe(node));
  return int(value);
}

void read_ddm(const Node& node, Scene& scene) {
  DdmSpec& ddm = scene.method.ddm;
  ddm.scheme = choice(find(node, "scheme"),
                      {Scheme::neumann_dirichlet, Scheme::neumann_neumann, Scheme::dirichlet_dirichlet}, ddm.scheme);
  if (const Node* acceleration = find(node, "acceleration"))
    ddm.acceleration =
        choice(acceleration, {Acceleration::none, Acceleration::aitken, Acceleration::anderson, Acceleration::krylov},
               Acceleration::none);
  ddm.beta = read_beta(find(node, "beta"));
  ddm.transfer = choice(find(node, "transfer"), {Transfer::mortar, Transfer::nodal}, ddm.transfer);
  if (const Node* tolerance = find(node, "tolerance")) ddm.tolerance = positive_number(*tolerance);
  if (const Node* most = find(node, "max_iterations")) ddm.max_iterations = read_count(*most);
  const Node* dirichlet = find(node, "dirichlet");
  if (dirichlet == nullptr) return;
  std::vector<std::string> known;
  for (const BodySpec& body : scene.bodies) known.push_back(body.name);
  for (const Node* body : names(*dirichlet)) {
    if (std::find(known.begin(), known.end(), body->text) == known.end())
      fail(*body, unknown_name("body", body->text, known));
    ddm.dirichlet.push_back(body->text);
  }
}

}  // namespace

void read_method(const Node& root, Scene& scene) {
  const Node* node = find(root, "method");
  if (node == nullptr) return;
  const std::vector<std::string> of_ddm{"scheme",   "acceleration", "beta",          "dirichlet",
                                        "transfer", "tolerance",    "max_iterations"};
  std::vector<std::string> keys{"kind", "integration", "multipliers"};
  keys.insert(keys.end(), of_ddm.begin(), of_ddm.end());
  expect_keys(*node, keys);
  Method& method = scene.method;
  method.kind = choice(find(*node, "kind"), {MethodKind::mortar, MethodKind::ddm}, method.kind);
  method.integration =
      choice(find(*node, "integration"), {Integration::segments, Integration::elements}, method.integration);
  method.multipliers = choice(find(*node, "multipliers"),
                              {Multipliers::quadratic, Multipliers::linear, Multipliers::dual}, method.multipliers);
  if (method.kind == MethodKind::mortar)
    for (const std::string& key : of_ddm)
      if (const Node* extra = find(*node, key))
        fail(*extra, "belongs to domain decomposition; expected kind = \"ddm\" with it");
  read_ddm(*node, scene);
}

}  // namespace mortise::scene_file
