// Bars of forces: round-off where equilibrium gives them, the stiffnesses' where it does not.
#include "error/force_errors.hpp"

#include <gtest/gtest.h>

#include <numbers>

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

// What weighs rests on a block, of straight sides that cut a part off its rim and leave one too many in its hole.
void expect_weight_within_bar(double hole, const std::string& elements) {
  const TemporaryFolder folder;
  const std::string disc = hole > 0 ? "Circle(2) = {0, 1, 0, 0.5}; Curve Loop(2) = {2}; Plane Surface(1) = {1, 2};"
                                    : "Plane Surface(1) = {1};";
  folder.write("d.geo", "SetFactory(\"OpenCASCADE\"); Circle(1) = {0, 1, 0, 1}; Curve Loop(1) = {1};" + disc + R"(
Rectangle(3) = {-2, -1, 0, 4, 1}; c() = Abs(Boundary{ Surface{3}; });
Physical Surface("disc") = {1}; Physical Surface("block") = {3};
Physical Curve("rim") = {1}; Physical Curve("base") = {c(0)}; Physical Curve("top") = {c(2)};
MeshSize{:} = 0.2; )" + elements);
  Results r = solve_scene(read_scene(folder.write("d.toml", R"(
mesh.file = "d.geo"
model.gravity = [0, -1]
materials = { a = { young = 1e3, poisson = 0.3, density = 1 }, b = { young = 1e3, poisson = 0.3, density = 1e-9 } }
bodies = { disc = "a", block = "b" }
boundary = [{ on = "base", displacement = { x = 0, y = 0 } }]
contact = [{ between = ["rim", "top"] }]
)")));
  estimate(r);
  const double weight = std::numbers::pi * (1 - hole * hole), bar = (*r.recovery.contacts[0].force_error)(1);
  const double off = std::abs(std::abs(r.recovery.contacts[0].force.y()) - weight);
  EXPECT_GT(off, 1e-5 * weight) << hole << elements;
  EXPECT_LE(off, bar) << hole << elements;
  EXPECT_LE(bar, 0.03 * weight) << hole << elements;
}

TEST(ForceErrors, KnowWhatStraightSidesCutOff) {
  for (const double hole : {0., 0.5})
    for (const char* elements : {"Mesh.ElementOrder = 1;", "Mesh.ElementOrder = 2; Mesh.SecondOrderLinear = 1;"})
      expect_weight_within_bar(hole, elements);
}

// A tube in a tube, pressed from within, of straight sides: p by Lame, on a quarter of radius 2.
TEST(ForceErrors, KnowWhatStraightSidesDoToStiffnesses) {
  const TemporaryFolder folder;
  for (const char* size : {"0.2", "0.1", "0.05"}) {
    folder.write("t.geo", std::string("h = ") + size + R"(;
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {0, 1, 0}; Point(4) = {2, 0, 0}; Point(5) = {0, 2, 0};
Circle(1) = {2, 1, 3}; Line(2) = {3, 5}; Circle(3) = {5, 1, 4}; Line(4) = {4, 2};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(12) = {3.5, 0, 0}; Point(13) = {0, 3.5, 0}; Point(14) = {2, 0, 0}; Point(15) = {0, 2, 0};
Circle(11) = {14, 1, 15}; Line(12) = {15, 13}; Circle(13) = {13, 1, 12}; Line(14) = {12, 14};
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
Physical Surface("inner") = {1}; Physical Surface("outer") = {2};
Physical Curve("bore") = {1}; Physical Curve("in") = {3}; Physical Curve("out") = {11};
Physical Curve("left") = {2, 12}; Physical Curve("bottom") = {4, 14};
MeshSize{2:5} = h; MeshSize{12:15} = 1.6 * h; Mesh.ElementOrder = 2; Mesh.SecondOrderLinear = 1;
)");
    Results r = solve_scene(read_scene(folder.write("t.toml", R"(
mesh.file = "t.geo"
materials = { a = { young = 200, poisson = 0.3 }, b = { young = 70, poisson = 0.35 } }
bodies = { inner = "a", outer = "b" }
boundary = [{ on = "bore", pressure = 1 }, { on = "left", displacement = { x = 0 } },
            { on = "bottom", displacement = { y = 0 } }]
contact = [{ between = ["in", "out"] }]
)")));
    estimate(r);
    const auto grows = [](double E, double nu, double a, double b,
                          double r) {  // per unit of pressure at a, from within
      return (1 + nu) / E * a * a / (b * b - a * a) * ((1 - 2 * nu) * r + b * b / r);
    };
    const double outside = (1 + 0.3) / 200 * 4 / (4 - 1) * ((1 - 0.6) * 2 + 1 / 2.);  // pressed at 2 from without
    const double p = grows(200, 0.3, 1, 2, 2) / (outside + grows(70, 0.35, 2, 3.5, 2));
    for (const int c : {0, 1}) {
      const double off = std::abs(std::abs(r.recovery.contacts[0].force(c)) - 2 * p);
      const double bar = (*r.recovery.contacts[0].force_error)(c);
      EXPECT_LE(off, bar) << size;
      EXPECT_LE(bar, 6 * off) << size;
    }
  }
}

// Fluid between a block and a rounded foot, whose sides part: it presses both along the multiplier side's normals, so
// that the force on the block hangs on where its front stands, and that on the foot is its load.
TEST(ForceErrors, KnowWhatAFrontOfFluidMayDo) {
  const auto force = [](double size, const char* on) {
    const TemporaryFolder folder;
    std::string geo = "SetFactory(\"OpenCASCADE\"); h = " + std::to_string(size) + R"(;
For k In {0:12}
  Point(k + 1) = {-0.6 + 0.1 * k, 0.5 * (-0.6 + 0.1 * k)^2, 0};
EndFor
Spline(1) = {1:13}; Point(14) = {0.6, 0.7, 0}; Point(15) = {-0.6, 0.7, 0}; Line(2) = {13, 14}; Line(3) = {14, 15};
Line(4) = {15, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Rectangle(2) = {-1.2, -0.8, 0, 2.4, 0.8}; c() = Abs(Boundary{ Surface{2}; });
Physical Surface("foot") = {1}; Physical Surface("block") = {2}; Physical Curve("sole") = {1}; Physical Curve("head") = {3};
Physical Curve("side") = {4}; Physical Curve("ground") = {c(0)}; Physical Curve("top") = {c(2)};
Mesh.ElementOrder = 2; MeshSize{:} = h;
)";
    folder.write("f.geo", geo);
    Results r = solve_scene(read_scene(folder.write("f.toml", std::string(R"(mesh.file = "f.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies."*" = "m"
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "side", displacement = { x = 0 } },
            { on = "head", pressure = 20 }]
contact = [{ between = ["sole", "top"], multipliers_on = ")") + on +
                                                                  R"(", fluid = { pressure = 5, from = [0.6, 0.18] } }]
)")));
    estimate(r);
    return std::pair(std::abs(r.recovery.contacts[0].force.y()), (*r.recovery.contacts[0].force_error)(1));
  };
  const double load = 20 * 1.2;
  const auto [of_foot, round_off] = force(0.1, "sole");
  EXPECT_NEAR(of_foot, load, 1e-9 * load);
  EXPECT_LT(round_off, 1e-9 * load);
  const auto [fine, fine_bar] = force(0.02, "top");
  double before = 0.01 * load;
  for (const double size : {0.16, 0.08, 0.04}) {
    const auto [block, bar] = force(size, "top");
    EXPECT_LE(std::abs(block - fine), bar + fine_bar) << size;
    EXPECT_GT(std::abs(block - fine), 1e-6 * load) << size;
    EXPECT_LT(bar, before) << size;
    before = bar;
  }
}

}  // namespace
}  // namespace mortise::test
