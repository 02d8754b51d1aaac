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

void read_ddm(const Node& node, const Node& chosen, Scene& scene) {
  if (scene.contacts.empty())
    fail(chosen, "domain decomposition needs a [[contact]] to iterate on; expected one, or solver = \"direct\"");
  DdmOptions& ddm = scene.method.ddm;
  ddm.scheme = choice(find(node, "scheme"),
                      {Scheme::neumann_dirichlet, Scheme::neumann_neumann, Scheme::dirichlet_dirichlet}, ddm.scheme);
  ddm.acceleration = choice(find(node, "acceleration"),
                            {Acceleration::none, Acceleration::aitken, Acceleration::anderson, Acceleration::krylov},
                            ddm.acceleration);
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
    scene.method.dirichlet.push_back(body->text);
  }
}

void read_mssor(const Node& node, Scene& scene) {
  MssorOptions& mssor = scene.method.mssor;
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

void read_feti(const Node& node, FetiOptions& feti) {
  if (const Node* tolerance = find(node, "tolerance")) feti.tolerance = positive_number(*tolerance);
  if (const Node* most = find(node, "max_iterations")) feti.max_iterations = read_count(*most);
}

// "solver"; scene files written before it could say "ddm" say kind = "ddm", and "mortar" for what is not.
std::optional<Solver> read_solver(const Node& node) {
  const Node *solver = find(node, "solver"), *kind = find(node, "kind");
  std::optional<Solver> chosen;
  if (solver != nullptr)
    chosen = choice(solver, {Solver::direct, Solver::mssor, Solver::ddm, Solver::feti}, Solver::direct);
  if (kind == nullptr) return chosen;
  const bool ddm = text(*kind) == "ddm";
  if (!ddm && text(*kind) != "mortar") fail(*kind, unknown_name("kind", kind->text, {"mortar", "ddm"}));
  if (chosen && ddm != (chosen == Solver::ddm))
    fail(blame(*kind, *solver), "kind = \"" + kind->text + "\" and solver = \"" + to_string(*chosen) +
                                    "\" contradict one another; expected solver alone");
  return ddm ? Solver::ddm : chosen;
}

// Keys that stand without what they belong to.
void refuse_strangers(const Node& node, const std::vector<std::string>& keys, const std::string& message) {
  for (const std::string& key : keys)
    if (const Node* extra = find(node, key)) fail(*extra, message);
}

const std::vector<std::string> of_ddm{"scheme", "beta", "dirichlet"};
const std::vector<std::string> of_mssor{"omega", "tau"};
const std::vector<std::string> of_iterations{"tolerance", "max_iterations"};

}  // namespace

void read_method(const Node& root, Scene& scene) {
  const Node* node = find(root, "method");
  if (node == nullptr) return;
  std::vector<std::string> keys{"kind", "integration", "normals", "multipliers", "solver", "acceleration"};
  for (const auto& some : {of_ddm, of_mssor, of_iterations}) keys.insert(keys.end(), some.begin(), some.end());
  expect_keys(*node, keys);
  Method& method = scene.method;
  method.integration =
      choice(find(*node, "integration"), {Integration::segments, Integration::elements}, method.integration);
  method.normals = choice(find(*node, "normals"), {Normals::edges, Normals::curve}, method.normals);
  method.multipliers = choice(find(*node, "multipliers"),
                              {Multipliers::quadratic, Multipliers::linear, Multipliers::dual}, method.multipliers);
  method.solver = read_solver(*node);
  const bool ddm = method.solver == Solver::ddm, mssor = method.solver == Solver::mssor,
             feti = method.solver == Solver::feti;
  if (!ddm) refuse_strangers(*node, of_ddm, "belongs to domain decomposition; expected solver = \"ddm\" with it");
  if (!mssor) refuse_strangers(*node, of_mssor, "belongs to the iterative solver; expected solver = \"mssor\" with it");
  if (!ddm && !mssor)
    refuse_strangers(*node, {"acceleration"},
                     "belongs to an iteration that has some; expected solver = \"ddm\" or \"mssor\" with it");
  if (!ddm && !mssor && !feti)
    refuse_strangers(*node, of_iterations,
                     "belongs to an iteration; expected solver = \"feti\", \"ddm\" or \"mssor\" with it");
  if (ddm) read_ddm(*node, *(find(*node, "solver") ? find(*node, "solver") : find(*node, "kind")), scene);
  if (mssor) read_mssor(*node, scene);
  if (feti) read_feti(*node, method.feti);
}

}  // namespace mortise::scene_file
