// Every method against the mortar method's direct solver, under random documented settings on tiny meshes: the same
// answer, or a refusal, or "not converged"; never another answer, and nothing that is not finite.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "base/errors.hpp"
#include "support/differences.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

struct Setting {
  Scene scene;
  TwoPlates plates;
  std::string words;  // what was drawn, for messages
};

// Draws one of a table's entries and says which.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  template <typename T>
  T one_of(const char* name, std::initializer_list<std::pair<const char*, T>> table) {
    const auto& [word, value] = table.begin()[random_() % table.size()];
    words_ << " " << name << "=" << word;
    return value;
  }
  double one_of(const char* name, std::initializer_list<double> table) {
    const double value = table.begin()[random_() % table.size()];
    words_ << " " << name << "=" << value;
    return value;
  }
  std::string words() const { return words_.str(); }

 private:
  std::mt19937 random_;
  std::ostringstream words_;
};

CellKind cell_kind(Draw& draw, const char* name) {
  return draw.one_of<CellKind>(name, {{"tri3", CellKind::tri3},
                                      {"tri6", CellKind::tri6},
                                      {"quad4", CellKind::quad4},
                                      {"quad8", CellKind::quad8},
                                      {"quad9", CellKind::quad9}});
}

TwoPlates draw_plates(Draw& draw) {
  using Height = std::function<double(double)>;
  TwoPlates plates;
  plates.n_upper = int(draw.one_of("n_upper", {2, 3, 4, 5, 7}));
  plates.n_lower = int(draw.one_of("n_lower", {2, 3, 4, 5, 7}));
  plates.kind_upper = cell_kind(draw, "upper");
  plates.kind_lower = cell_kind(draw, "lower");
  plates.height = draw.one_of<Height>("line", {{"flat", [](double) { return 0.3; }},
                                               {"inclined", [](double x) { return 0.25 + x / 8; }},
                                               {"parabola", [](double x) { return 0.2 + x - 1.25 * x * x; }}});
  return plates;
}

void draw_bodies(Draw& draw, Scene& scene) {
  scene.model.plane = draw.one_of<Plane>("plane", {{"strain", Plane::strain}, {"stress", Plane::stress}});
  const double nu = draw.one_of("nu", {0, 0.3, 0.45});
  scene.materials["steel"] = {210e9, nu, 0};
  scene.materials["other"] = {210e9 * draw.one_of("ratio", {0.01, 0.2, 1, 1, 5, 100}), nu, 0};
  scene.bodies = {{"upper", "other"}, {"lower", "steel"}};
  BoundarySpec& top = scene.boundaries.back();
  if (draw.one_of("load", {0, 1}) > 0) return;  // the pressure of 10 MPa
  Displacement u{{}, draw.one_of("displacement", {-1e-5, -1e-3})};
  if (draw.one_of("top_x", {0, 1}) > 0) u.x = 0;
  top.what = u;
}

void draw_contact(Draw& draw, Scene& scene) {
  ContactSpec& contact = scene.contacts[0];
  contact.condition =
      draw.one_of<Condition>("condition", {{"bilateral", Condition::bilateral}, {"unilateral", Condition::unilateral}});
  contact.initial_gap = draw.one_of<InitialGap>(
      "initial_gap",
      {{"closed", InitialGap::closed}, {"measured", InitialGap::measured}, {"curve", InitialGap::curve}});
  scene.method.normals = draw.one_of<Normals>("normals", {{"edges", Normals::edges}, {"curve", Normals::curve}});
  contact.multipliers_on = draw.one_of<std::string>(
      "multipliers_on", {{"default", ""}, {"upper", "upper_contact"}, {"lower", "lower_contact"}});
  scene.method.multipliers = draw.one_of<Multipliers>(
      "multipliers",
      {{"linear", Multipliers::linear}, {"quadratic", Multipliers::quadratic}, {"dual", Multipliers::dual}});
  scene.method.integration = draw.one_of<Integration>(
      "integration", {{"segments", Integration::segments}, {"elements", Integration::elements}});
}

void draw_ddm(Draw& draw, Scheme scheme, Method& method) {
  using Bodies = std::vector<std::string>;
  method.solver = Solver::ddm;
  method.ddm.scheme = scheme;
  method.ddm.tolerance = 1e-10;
  method.ddm.max_iterations = 200;
  method.ddm.acceleration = draw.one_of<Acceleration>("acceleration", {{"none", Acceleration::none},
                                                                       {"aitken", Acceleration::aitken},
                                                                       {"anderson", Acceleration::anderson},
                                                                       {"krylov", Acceleration::krylov}});
  method.dirichlet = draw.one_of<Bodies>("dirichlet", {{"default", {}}, {"upper", {"upper"}}, {"lower", {"lower"}}});
}

void draw_mssor(Draw& draw, Method& method) {
  method.solver = Solver::mssor;
  method.mssor.acceleration = draw.one_of<Acceleration>(
      "acceleration",
      {{"none", Acceleration::none}, {"krylov", Acceleration::krylov}, {"minres", Acceleration::minres}});
  method.mssor.omega = draw.one_of("omega", {0.5, 1, 1.3, 1.8});
  method.mssor.tau = draw.one_of("tau", {0.05, 0.7, 3, 1e300});
  method.mssor.max_iterations = 5000;
}

// `method`: the scheme of domain decomposition, mssor or feti.
Setting draw_setting(const std::string& method, unsigned seed) {
  Draw draw(seed);
  Setting s;
  s.scene = draw.one_of("support", {0, 1}) > 0 ? clamped_scene() : uniaxial_scene();
  s.plates = draw_plates(draw);
  draw_bodies(draw, s.scene);
  draw_contact(draw, s.scene);
  if (method == "mssor") draw_mssor(draw, s.scene.method);
  if (method == "feti") s.scene.method.solver = Solver::feti;
  for (const Scheme scheme : {Scheme::neumann_dirichlet, Scheme::neumann_neumann, Scheme::dirichlet_dirichlet})
    if (method == to_string(scheme)) draw_ddm(draw, scheme, s.scene.method);
  s.words = method + draw.words();
  return s;
}

// Nothing where the scene is refused.
std::optional<Results> solved_if_held(const Scene& scene, const TwoPlates& plates) {
  try {
    return solve_scene(scene, mesh_of(plates));
  } catch (const InputError&) {
    return {};
  }
}

void expect_finite(const Results& r) {
  EXPECT_TRUE(r.solution.u.allFinite());
  EXPECT_TRUE(std::isfinite(r.recovery.energy));
  for (const ContactResults& c : r.recovery.contacts) EXPECT_TRUE(c.pressure.allFinite());
  for (const Check& c : r.checks) EXPECT_TRUE(std::isfinite(c.value)) << c.name;
}

std::string told(const Results& r) {
  std::ostringstream text;
  text << to_string(r.status) << ", largest displacement " << largest_entry(r.solution.u);
  for (const Check& c : r.checks) text << "\n  " << c.name << " " << c.value;
  for (const std::string& note : r.warnings) text << "\n  " << note;
  return text.str();
}

class Differential : public testing::TestWithParam<const char*> {};

TEST_P(Differential, EachMethodAgreesWithTheDirectOneOrSaysThatItDoesNot) {
  int compared = 0, refused = 0, unfinished = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Setting s = draw_setting(GetParam(), seed);
    SCOPED_TRACE(std::to_string(seed) + ": " + s.words);
    std::optional<Results> found;
    ASSERT_NO_THROW(found = solved_if_held(s.scene, s.plates));
    if (!found || found->status == Status::not_converged) {
      ++(found ? unfinished : refused);
      continue;
    }
    expect_finite(*found);
    Scene direct = s.scene;
    direct.method.solver = Solver::direct;
    direct.contacts[0].multipliers_on = found->problem.pairs[0].spec.multipliers_on;
    const std::optional<Results> reference = solved_if_held(direct, s.plates);
    ASSERT_TRUE(reference.has_value()) << "the direct method refuses the scene";
    ++compared;
    EXPECT_EQ(to_string(found->status), to_string(reference->status));
    EXPECT_LE(pressure_difference(*found, *reference), 1e-6) << told(*found);
    EXPECT_LE(largest_entry(found->solution.u - reference->solution.u), 1e-6 * largest_entry(reference->solution.u));
  }
  std::printf("%s: %d compared, %d refused, %d not converged\n", GetParam(), compared, refused, unfinished);
  EXPECT_GE(compared, 25);
}

INSTANTIATE_TEST_SUITE_P(Methods, Differential,
                         testing::Values("neumann_dirichlet", "neumann_neumann", "dirichlet_dirichlet", "mssor",
                                         "feti"),
                         [](const auto& method) { return std::string(method.param); });

}  // namespace
}  // namespace mortise::test
