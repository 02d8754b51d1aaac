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
  if (scene.contacts.empty())
    fail(*find(node, "kind"), "domain decomposition needs a [[contact]] to iterate on; expected one, or \"mortar\"");
  DdmSpec& ddm = scene.method.ddm;
  ddm.scheme = choice(find(node, "scheme"),
                      {Scheme::neumann_dirichlet, Scheme::neumann_neumann, Scheme::dirichlet_dirichlet}, ddm.scheme);
  if (const Node* acceleration = find(node, "acceleration"))
    ddm.acceleration =
        choice(acceleration, {Acceleration::none, Acceleration::aitken, Acceleration::anderson, Acceleration::krylov},
               Acceleration::none);
  ddm.beta = read_beta(find(node, "beta"));
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

void read_mssor(const Node& node, Scene& scene) {
  MssorSpec& mssor = scene.method.mssor;
  if (const Node* omega = find(node, "omega")) {
    mssor.omega = number(*omega);
    if (!(mssor.omega > 0 && mssor.omega < 2))
      fail(*omega, "expected a number between 0 and 2 (both excluded), found " + describe(*omega));
  }
  if (const Node* tau = find(node, "tau")) mssor.tau = positive_number(*tau);
  mssor.acceleration = choice(find(node, "acceleration"),
                              {Acceleration::none, Acceleration::krylov, Acceleration::minres}, mssor.acceleration);
  if (const Node* tolerance = find(node, "tolerance")) mssor.tolerance = positive_number(*tolerance);
  if (const Node* most = find(node, "max_iterations")) mssor.max_iterations = read_count(*most);
}

// Keys that stand without what they belong to.
void refuse_strangers(const Node& node, const std::vector<std::string>& keys, const std::string& message) {
  for (const std::string& key : keys)
    if (const Node* extra = find(node, key)) fail(*extra, message);
}

const std::vector<std::string> of_ddm{"scheme", "beta", "dirichlet"};
const std::vector<std::string> of_mssor{"omega", "tau"};
const std::vector<std::string> of_both{"acceleration", "tolerance", "max_iterations"};

}  // namespace

void read_method(const Node& root, Scene& scene) {
  const Node* node = find(root, "method");
  if (node == nullptr) return;
  std::vector<std::string> keys{"kind", "integration", "multipliers", "solver"};
  for (const auto& some : {of_ddm, of_mssor, of_both}) keys.insert(keys.end(), some.begin(), some.end());
  expect_keys(*node, keys);
  Method& method = scene.method;
  method.kind = choice(find(*node, "kind"), {MethodKind::mortar, MethodKind::ddm}, method.kind);
  method.integration =
      choice(find(*node, "integration"), {Integration::segments, Integration::elements}, method.integration);
  method.multipliers = choice(find(*node, "multipliers"),
                              {Multipliers::quadratic, Multipliers::linear, Multipliers::dual}, method.multipliers);
  method.solver = choice(find(*node, "solver"), {Solver::direct, Solver::mssor}, method.solver);
  const bool ddm = method.kind == MethodKind::ddm, mssor = method.solver == Solver::mssor;
  if (ddm && mssor)
    fail(*find(*node, "solver"), "\"mssor\" solves the system of all bodies; expected kind = \"mortar\" with it");
  if (!ddm) refuse_strangers(*node, of_ddm, "belongs to domain decomposition; expected kind = \"ddm\" with it");
  if (!mssor) refuse_strangers(*node, of_mssor, "belongs to the iterative solver; expected solver = \"mssor\" with it");
  if (!ddm && !mssor)
    refuse_strangers(*node, of_both,
                     "belongs to an iteration; expected kind = \"ddm\" (domain decomposition) or solver = \"mssor\" "
                     "with it");
  if (ddm) read_ddm(*node, scene);
  if (mssor) read_mssor(*node, scene);
}

}  // namespace mortise::scene_file
