// Bars of forces: round-off where equilibrium gives them, the stiffnesses' where it does not.
#include "error/force_errors.hpp"

#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A beam on three posts with rounded tops, which share its load as the beam bends.
Results beam(double size) {
  constexpr int posts = 3;
  const TemporaryFolder folder;
  std::string geo = "Mesh.ElementOrder = 2; Mesh.CharacteristicLengthMax = " + std::to_string(size) +
                    "; Mesh.CharacteristicLengthMin = " + std::to_string(size) + R"(;
SetFactory("OpenCASCADE");
Rectangle(1) = {-1, 0, 0, 12, 1};
Physical Surface("beam") = {1}; Physical Curve("under") = {1}; Physical Curve("load") = {3};
)";
  std::string bodies = "beam = \"steel\"", boundaries = "{ on = \"load\", pressure = 1e6 }", contacts;
  for (int k = 0; k < posts; ++k) {
    const std::string n = std::to_string(k), x = std::to_string(k * 10.0 / (posts - 1) - 0.5);
    const std::string first = std::to_string(100 + 10 * k), tag = std::to_string(10 + k);
    const auto at = [&](int i) { return std::to_string(100 + 10 * k + i); };
    geo += "x = " + x + "; Point(" + at(1) + ") = {x, -2, 0}; Point(" + at(2) + ") = {x + 1, -2, 0}; Point(" + at(3) +
           ") = {x + 1, -0.05, 0}; Point(" + at(4) + ") = {x, -0.05, 0}; Point(" + at(5) +
           ") = {x + 0.5, -2.525, 0};\nLine(" + at(1) + ") = {" + at(1) + ", " + at(2) + "}; Line(" + at(2) + ") = {" +
           at(2) + ", " + at(3) + "}; Circle(" + at(3) + ") = {" + at(3) + ", " + at(5) + ", " + at(4) + "}; Line(" +
           at(4) + ") = {" + at(4) + ", " + at(1) + "}; Curve Loop(" + tag + ") = {" + at(1) + " : " + at(4) +
           "}; Plane Surface(" + tag + ") = {" + tag + "};\nPhysical Surface(\"post_" + n + "\") = {" + tag +
           "}; Physical Curve(\"foot_" + n + "\") = {" + at(1) + "}; Physical Curve(\"top_" + n + "\") = {" + at(3) +
           "};\n";
    bodies += ", post_" + n + " = \"steel\"";
    boundaries += ", { on = \"foot_" + n + "\", displacement = { x = 0, y = 0 } }";
    contacts += (k > 0 ? ", " : "") + ("{ between = [\"under\", \"top_" + n + "\"] }");
  }
  folder.write("b.geo", geo);
  Results r = solve_scene(read_scene(
      folder.write("b.toml", "mesh.file = \"b.geo\"\nmaterials.steel = { young = 210e9, poisson = 0.3 }\nbodies = { " +
                                 bodies + " }\nboundary = [" + boundaries + "]\ncontact = [" + contacts + "]\n")));
  estimate(r);
  return r;
}

// The load is vertical; of the half cylinder the symmetry plane takes what p does sideways.
TEST(ForceErrors, AreRoundOffWhereEquilibriumGivesTheForce) {
  for (const char* n : {"2", "8"}) {
    Results r = solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/hertz.toml",
                                       {{"mesh.parameters.n_upper", n}, {"mesh.parameters.n_lower", n}}));
    estimate(r);
    const Vec2& force = r.recovery.contacts[0].force;
    const Eigen::Vector3d& error = *r.recovery.contacts[0].force_error;
    EXPECT_NEAR(std::abs(force.y()), 4.6e6, error(1)) << n;
    EXPECT_LE(error(1), 1e-9 * 4.6e6) << n;
    EXPECT_GT(error(1), 0) << n;
    EXPECT_GT(error(0), 1e-6 * std::abs(force.x())) << n;
  }
}

TEST(ForceErrors, HoldWhereTheStiffnessesShareTheLoad) {
  const Results fine = beam(0.06);
  double before = 1;
  for (const double size : {0.8, 0.4, 0.2}) {
    const Results r = beam(size);
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double reference = fine.recovery.contacts[k].force.y(), bar = (*r.recovery.contacts[k].force_error)(1);
      EXPECT_LE(std::abs(r.recovery.contacts[k].force.y() - reference), bar) << size;
      largest = std::max(largest, bar / std::abs(reference));
    }
    EXPECT_LT(largest, before) << size;
    before = 0.7 * largest;
  }
}

}  // namespace
}  // namespace mortise::test
