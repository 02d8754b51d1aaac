// Contact that gives way, p = k times the overlap, from scene to results: exact answers.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iomanip>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "base/printable.hpp"
#include "support/messages.hpp"
#include "support/two_blocks.hpp"

namespace mortise::test {
namespace {

Scene rough_scene(const std::string& name, const std::vector<Override>& overrides) {
  return read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml", overrides);
}

// ---- Uniaxial strain: three springs in a row ----

constexpr double gap = 1e-4, M_upper = 210e9 * 0.7 / (1.3 * 0.4), M_lower = M_upper / 3,
                 compliance = 0.3 / M_upper + 0.3 / M_lower;

Results pressed_down(double d, const std::string& law, const std::vector<Override>& more) {
  std::ostringstream down;
  down << std::setprecision(17) << "{y=" << -d << "}";
  std::vector<Override> overrides{{"boundary.2.displacement", down.str()}, {"contact.0.stiffness", law}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return solve_scene(rough_scene("gap_close", overrides));
}

// The p that closes d, of what has the overlap of p.
double pressure_in(double d, const std::function<double(double)>& overlap) {
  double low = 0, high = std::max(0.0, (d - gap) / compliance);
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (gap + compliance * middle + overlap(middle) < d ? low : high) = middle;
  }
  return high;
}

struct Law {
  const char* text;
  std::function<double(double)> overlap;
};

// Of p = 20 MPa at 10 um: in proportion, a power, a table.
const Law laws[] = {
    {"2e12", [](double p) { return p / 2e12; }},
    {"{pressure=2e7, overlap=1e-5, exponent=2.5}", [](double p) { return 1e-5 * std::pow(p / 2e7, 1 / 2.5); }},
    {"[[0, 0], [4e-6, 1e6], [1e-5, 2e7]]",
     [](double p) { return p < 1e6 ? 4e-12 * p : 4e-6 + 6e-6 * (p - 1e6) / 19e6; }}};

class GivingWay : public testing::TestWithParam<std::tuple<int, double, const char*, const char*, const char*>> {};

TEST_P(GivingWay, IsExactInUniaxialStrain) {
  const auto [law, down, space, side, solver] = GetParam();
  const double d = down * 1e-4, p = pressure_in(d, laws[law].overlap);
  const Results r = pressed_down(
      d, laws[law].text, {{"method.multipliers", space}, {"contact.multipliers_on", side}, {"method.solver", solver}});
  EXPECT_EQ(r.status, Status::solved);
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes) {
    EXPECT_NEAR(n.p, p, 1e-8 * 47e6);
    EXPECT_NEAR(n.gap, p > 0 ? -laws[law].overlap(p) : gap - d, 1e-8 * d);
  }
}

INSTANTIATE_TEST_SUITE_P(BothSidesOfTouching, GivingWay,
                         testing::Combine(testing::Values(0, 1, 2), testing::Values(0.5, 1.000001, 3),
                                          testing::Values("linear", "quadratic", "dual"),
                                          testing::Values("upper_contact", "lower_contact"),
                                          testing::Values("direct", "feti")));

// Drawn: power laws and tables, whose given points are far off what comes about.
class DrawnLaws : public testing::TestWithParam<int> {};

TEST_P(DrawnLaws, HaveThePressureOfOneEquation) {
  std::mt19937 draw(GetParam());
  std::uniform_real_distribution<double> part(0, 1);
  const double d = gap * (1 + 3 * part(draw)), scale = std::pow(10, 8 * part(draw) - 4),
               exponent = 1 + 9 * part(draw) * part(draw), c = std::pow(10, 6 + 4 * part(draw));  // p at d
  std::ostringstream text;
  text.precision(17);
  std::vector<Vec2> points;
  if (GetParam() % 2 == 0) {
    text << "{pressure=" << c * std::pow(scale, exponent) << ", overlap=" << d * scale << ", exponent=" << exponent
         << "}";
  } else {
    Vec2 point(0, 0);
    text << "[";
    for (int i = 0; i < 5; ++i) {
      point += Vec2(d * scale * part(draw), c * scale * std::pow(10, 2 * part(draw) - 1));
      points.push_back(point);
      text << (i > 0 ? ", [" : "[") << point.x() << ", " << point.y() << "]";
    }
    text << "]";
  }
  const auto overlap = [&](double p) {
    if (points.empty()) return d * std::pow(p / c, 1 / exponent);
    std::size_t i = 0;
    while (i + 1 < points.size() && points[i].y() < p) ++i;
    const Vec2 from = i > 0 ? points[i - 1] : Vec2(0, 0), to = points[i];
    return from.x() + (p - from.y()) * (to - from).x() / (to - from).y();
  };
  const Results r = pressed_down(d, text.str(), {{"mesh.parameters.n_upper", "2"}, {"mesh.parameters.n_lower", "3"}});
  EXPECT_EQ(r.status, Status::solved) << text.str();
  EXPECT_LE(r.solution.layer_steps, 30) << text.str();
  RecordProperty("steps", r.solution.layer_steps);
  const double p = pressure_in(d, overlap);
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes) EXPECT_NEAR(n.p, p, 1e-8 * p) << text.str();
}

INSTANTIATE_TEST_SUITE_P(OneHundred, DrawnLaws, testing::Range(0, 100));

// Tables with steps, on which whole steps of Newton's method go round in circles.
TEST(ContactStiffness, OfATableWithSteps) {
  const char* steps[] = {"[[1e-5, 1e7], [1e-4, 1.01e7], [1.01e-4, 3e7], [1e-3, 3.01e7]]",
                         "[[1e-4, 1e4], [1.00001e-4, 3e7], [2e-3, 3.001e7]]"};
  for (const char* law : steps) EXPECT_EQ(pressed_down(3e-4, law, {}).status, Status::solved) << law;
}

TEST(ContactStiffness, OfACylinderOnATableWithSteps) {
  const Results cylinder =
      solve_scene(rough_scene("hertz", {{"contact.0.stiffness", "[[1e-5, 1e4], [1.1e-5, 1e8], [1e-3, 1.001e8]]"}}));
  EXPECT_EQ(cylinder.status, Status::solved);
  EXPECT_LE(cylinder.solution.layer_steps, 60);
}

// ---- A rigid cylinder on a Winkler foundation (Johnson 1985, section 4.3) ----

TEST(ContactStiffness, RigidCylinderOnAFoundation) {
  const double k = 1.38e13, P = 9.2e6, R = 1, a = std::cbrt(1.5 * P * R / k);
  Results r = solve_scene(rough_scene("hertz", {{"contact.0.stiffness", "1.38e13"},
                                                {"materials.steel.young", "1e18"},
                                                {"mesh.parameters.n_upper", "40"},
                                                {"mesh.parameters.n_lower", "50"}}));
  estimate(r);
  const ContactResults& contact = r.recovery.contacts[0];
  EXPECT_EQ(r.status, Status::solved);
  for (const ContactNode& n : contact.multiplier.nodes) {
    const double x = n.position.x(), p = std::max(0.0, k / (2 * R) * (a * a - x * x));
    EXPECT_NEAR(n.p, p, n.p_error + 1e-4 * k * a * a / (2 * R)) << x;
    EXPECT_LT(n.p_error, 0.05 * k * a * a / (2 * R)) << x;
  }
}

// Wherever its border lies between the vertices.
TEST(ContactStiffness, ContactEndsWhereTheSidesNoLongerOverlap) {
  for (const double k : {1e13, 1.38e13, 2e13, 3e13}) {
    const double P = 9.2e6, a = std::cbrt(1.5 * P / k);
    const Results r = solve_scene(rough_scene("hertz", {{"contact.0.stiffness", std::to_string(k)},
                                                        {"materials.steel.young", "1e18"},
                                                        {"mesh.parameters.n_upper", "15"},
                                                        {"mesh.parameters.n_lower", "19"}}));
    const ContactResults& contact = r.recovery.contacts[0];
    double edge = 0, before = 0;
    for (const ContactNode& n : contact.multiplier.nodes) {
      if (before < a && n.position.x() >= a) edge = n.position.x() - before;
      before = n.position.x();
    }
    EXPECT_NEAR(contact.length_in_contact, a, 0.05 * edge) << k;
  }
}

// Layers far stiffer than the bodies' edges are: what these overlap between vertices says nothing of where p ends.
TEST(ContactStiffness, ContactOfStiffLayersEndsWherePDoes) {
  std::mt19937 random(3);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int apart = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const double k = std::pow(10, draw(4, 8)), curved = draw(0.002, 0.02), middle = draw(0.2, 0.8);
    const int lower = 5 + int(random() % 10), upper = 5 + int(random() % 10);
    const std::string geo = worded("Rectangle(1) = {0, -0.5, 0, 1, 0.5}; Rectangle(2) = {0, 0, 0, 1, 0.7};\n",
                                   "Mesh.ElementOrder = ", 1 + trial % 2, "; Mesh.RecombineAll = ", trial / 2 % 2,
                                   ";\nTransfinite Curve{1, 3} = ", lower, "; Transfinite Curve{5, 7} = ", upper,
                                   "; Transfinite Curve{2, 4, 6, 8} = 4;");
    const Results r =
        pressed_blocks(geo, worded("initial_gap = \"", curved, " * (x - ", middle, ")^2\", stiffness = ", k));
    const ContactResults& contact = r.recovery.contacts[0];
    double carries = 0, beside = 0;  // edges that carry p at both vertices, at one
    std::vector<const ContactNode*> vertices;
    for (const ContactNode& node : contact.multiplier.nodes)
      if (std::abs(node.on_multiplier.xi) == 1) vertices.push_back(&node);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const double edge = vertices[i]->s - vertices[i - 1]->s;
      const int loaded = (vertices[i - 1]->p > 0) + (vertices[i]->p > 0);
      if (loaded > 0) (loaded == 2 ? carries : beside) += edge;
      apart += vertices[i]->p > 0 && vertices[i]->gap > 0;
    }
    SCOPED_TRACE(worded(geo, "\n", k, " ", curved, " ", middle));
    EXPECT_LE(contact.length_in_contact, carries + 2 * beside + 1e-9);
    EXPECT_GE(contact.length_in_contact, carries - beside - 1e-9);
  }
  EXPECT_GT(apart, 10);  // of vertices that press
}

// p = c g^n of the overlap g = (a^2 - x^2) / 2 R: with b(n) = sqrt(pi) Gamma(n + 1) / Gamma(n + 3/2) the load is
// c (2 R)^-n a^(2 n + 1) b(n).
class PowerLaws : public testing::TestWithParam<double> {};

TEST_P(PowerLaws, UnderARigidCylinder) {
  const double n = GetParam(), P = 9.2e6, R = 1, c = 5e8 / std::pow(1e-6, n),
               b = std::sqrt(M_PI) * std::tgamma(n + 1) / std::tgamma(n + 1.5),
               a = std::pow(P * std::pow(2 * R, n) / (c * b), 1 / (2 * n + 1)), p0 = c * std::pow(a * a / (2 * R), n);
  std::ostringstream law;
  law << "{pressure=5e8, overlap=1e-6, exponent=" << n << "}";
  Results r = solve_scene(rough_scene("hertz", {{"contact.0.stiffness", law.str()},
                                                {"materials.steel.young", "1e18"},
                                                {"mesh.parameters.n_upper", "40"},
                                                {"mesh.parameters.n_lower", "50"}}));
  estimate(r);
  EXPECT_EQ(r.status, Status::solved);
  for (const ContactNode& node : r.recovery.contacts[0].multiplier.nodes) {
    const double x = node.position.x(), p = p0 * std::pow(std::max(0.0, 1 - x * x / (a * a)), n);
    EXPECT_NEAR(node.p, p, node.p_error + 1e-4 * p0) << x;
    EXPECT_LT(node.p_error, 0.02 * n * p0) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(ContactStiffness, PowerLaws, testing::Values(2.5, 14));

// Beside contact the sides overlap by more than bodies without a layer could, under next to no pressure.
TEST(ContactStiffness, OverlapsThatHardlyPressAreNoMissedContact) {
  Results r = solve_scene(rough_scene("hertz", {{"contact.0.stiffness", "{pressure=5e8, overlap=1e-3, exponent=20}"},
                                                {"mesh.parameters.n_upper", "40"},
                                                {"mesh.parameters.n_lower", "50"}}));
  estimate(r);
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_LT(r.estimate->pressure(), 0.02);
}

TEST(ContactStiffness, CornersHaveAPressure) {
  Results hard = solve_scene(rough_scene("punch", {})),
          soft = solve_scene(rough_scene("punch", {{"contact.0.stiffness", "1e12"}}));
  estimate(hard);
  estimate(soft);
  EXPECT_FALSE(hard.estimate->pressures[0].singular.empty());
  EXPECT_TRUE(soft.estimate->pressures[0].singular.empty());
  EXPECT_EQ(soft.status, Status::solved);
}

TEST(ContactStiffness, GoesWithSolversThatHaveIt) {
  for (const char* solver : {"mssor", "ddm"})
    EXPECT_NE(message_of([&] {
                rough_scene("punch", {{"contact.0.stiffness", "1e12"}, {"method.solver", solver}});
              })
                  .find("does not solve contact that gives way, but contact.0 (line 32) has a stiffness; expected "
                        "\"direct\" or "
                        "\"feti\""),
              std::string::npos);
}

}  // namespace
}  // namespace mortise::test
