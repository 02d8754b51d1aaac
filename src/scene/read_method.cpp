// [method]
#include <algorithm>

#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

// A number > 0, or "auto", which is the same as no entry.
Kind<std::optional<double>> number_or_auto() {
  const Kind<double> number = above(0);
  return {either(number.schema, {{"const", "auto"}}),
          [=](const Node& node) -> std::optional<double> {
            if (node.kind == Node::Kind::string && node.text == "auto") return std::nullopt;
            return number.read(node);
          },
          [=](const std::optional<double>& value) { return value ? number.trouble(*value) : ""; }};
}

// "solver"; scene files written before it could say "ddm" say kind = "ddm", and "mortar" for what is not.
std::optional<Solver> read_solver(const Node& node) {
  const Node *solver = find(node, "solver"), *kind = find(node, "kind");
  std::optional<Solver> chosen;
  if (solver != nullptr) chosen = solver_word().read(*solver);
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

void check_solver(const Node& node, const Method& method) {
  const bool ddm = method.solver == Solver::ddm, mssor = method.solver == Solver::mssor,
             feti = method.solver == Solver::feti;
  if (!ddm)
    refuse_strangers(node, {"scheme", "beta", "dirichlet"},
                     "belongs to domain decomposition; expected solver = \"ddm\" with it");
  if (!mssor)
    refuse_strangers(node, {"omega", "tau"}, "belongs to the iterative solver; expected solver = \"mssor\" with it");
  if (!ddm && !mssor)
    refuse_strangers(node, {"acceleration"},
                     "belongs to an iteration that has some; expected solver = \"ddm\" or \"mssor\" with it");
  if (!ddm && !mssor && !feti)
    refuse_strangers(node, {"tolerance", "max_iterations"},
                     "belongs to an iteration; expected solver = \"feti\", \"ddm\" or \"mssor\" with it");
}

void check_ddm(const Node& node, const Scene& scene) {
  if (scene.contacts.empty())
    fail(*(find(node, "solver") ? find(node, "solver") : find(node, "kind")),
         "domain decomposition needs a [[contact]] to iterate on; expected one, or solver = \"direct\"");
  const Node* dirichlet = find(node, "dirichlet");
  if (dirichlet == nullptr) return;
  std::vector<std::string> known;
  for (const BodySpec& body : scene.bodies) known.push_back(body.name);
  for (const Node* body : names(*dirichlet))
    if (!std::ranges::count(known, body->text)) fail(*body, unknown_name("body", body->text, known));
}

// The preprint's solvers have no rows that give way.
void check_stiffness(const Node& node, const Scene& scene) {
  for (const ContactSpec& contact : scene.contacts)
    if (contact.stiffness)
      fail(*(find(node, "solver") ? find(node, "solver") : find(node, "kind")),
           "does not solve contact that gives way, but " + contact.key +
               " has a stiffness; expected \"direct\" or \"feti\"");
}

Kind<Acceleration> acceleration_of(const std::optional<Solver>& solver) {
  using enum Acceleration;
  if (solver == Solver::ddm) return one_of<Acceleration>({none, aitken, anderson, krylov});
  if (solver == Solver::mssor) return one_of<Acceleration>({none, krylov, minres});
  return any_of<Acceleration>();
}

}  // namespace

Kind<Solver> solver_word() { return any_of<Solver>(); }

Keys method_keys(Method& m) {
  const bool mssor = m.solver == Solver::mssor, feti = m.solver == Solver::feti;
  double& tolerance = mssor ? m.mssor.tolerance : feti ? m.feti.tolerance : m.ddm.tolerance;
  int& most = mssor ? m.mssor.max_iterations : feti ? m.feti.max_iterations : m.ddm.max_iterations;
  return {
      key("multipliers", m.multipliers, any_of<Multipliers>(),
          "`\"linear\"`, `\"quadratic\"`, `\"dual\"` (theory, section 4)"),
      key("integration", m.integration, any_of<Integration>(),
          "`\"segments\"`, or `\"elements\"`: whole edges without cutting"),
      key("normals", m.normals, any_of<Normals>(),
          "along which contact acts: those of the drawn `\"curve\"` of the multiplier side, or of its `\"edges\"`, for "
          "studies (theory, section 9)"),
      {"solver", solver_word().schema,
       "`\"direct\"`: one factorisation; `\"feti\"`: each body factorised alone, the pressures between any number of "
       "them by conjugate gradients (theory, section 15); `\"mssor\"`: block SSOR for saddle points, plain or as "
       "preconditioner, for contact that stays closed (theory, section 12); `\"ddm\"`: domain decomposition (theory, "
       "section 11). `kind = \"ddm\"` in older scene files means that",
       "`\"direct\"`; `\"feti\"` for many small bodies: three or more, with so many multipliers that a dense matrix of "
       "them costs more than its steps; and `\"direct\"` after all where its iteration does not converge"},
      {"kind", {{"enum", {"mortar", "ddm"}}}, "in older scenes; `solver` says it now", "`\"mortar\"`"},
      key("omega", m.mssor.omega, between(0, 2), "`mssor` only: 0 < `omega` < 2, relaxation of the sweeps"),
      key("tau", m.mssor.tau, above(0),
          "`mssor` only: > 0, step of the multipliers; `acceleration = \"none\"` converges below a limit that the "
          "summary gives"),
      key("scheme", m.ddm.scheme, any_of<Scheme>(),
          "`ddm` only, as all below but where another is named: `\"neumann_dirichlet\"`, `\"neumann_neumann\"`, "
          "`\"dirichlet_dirichlet\"`"),
      key("dirichlet", m.dirichlet, some_names(),
          "a body or a list of them that take the displacement; their opposites take the pressure",
          "the softer bodies; of equally stiff ones those with the finer curves; never a body whose whole contact "
          "curve is prescribed"),
      key("acceleration", mssor ? m.mssor.acceleration : m.ddm.acceleration, acceleration_of(m.solver),
          "`\"none\"`, `\"aitken\"`, `\"anderson\"`, `\"krylov\"`. With `mssor`: `\"none\"`, `\"krylov\"`, "
          "`\"minres\"`"),
      key("beta", m.ddm.beta, number_or_auto(),
          "relaxation > 0, or `\"auto\"`; of accelerated iterations the first step's. `\"krylov\"` has none",
          "`\"auto\"`"),
      key("tolerance", tolerance, above(0),
          "> 0, of the kinematic and the force residual, both relative; also with `feti` and `mssor`",
          "1e-8; `feti`, `mssor`: 1e-10"),
      key("max_iterations", most, whole_number(1, 1000000),
          "≥ 1, evaluations of the iteration (the start is the first); also with `feti` and `mssor`: steps",
          "1000; `mssor`: 20000"),
  };
}

void read_method(const Node& root, Scene& scene) {
  const Node* node = find(root, "method");
  if (node == nullptr) return;
  expect_table(*node);
  Method& method = scene.method;
  method.solver = read_solver(*node);
  const Keys keys = method_keys(method);
  expect_keys(*node, keys);
  check_solver(*node, method);
  if (method.solver == Solver::ddm) check_ddm(*node, scene);
  if (method.solver == Solver::ddm || method.solver == Solver::mssor) check_stiffness(*node, scene);
  read(*node, keys);
}

}  // namespace mortise::scene_file
