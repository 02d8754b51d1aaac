// Two blocks as a .geo draws them, and what presses them together.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <sstream>

#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {

/// Points and lines 1 to 4 and 5 to 8 around each block, turned about the origin.
inline std::string outlines(const std::array<Vec2, 8>& corners, double degrees) {
  std::ostringstream geo;
  const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
  geo.precision(17);
  for (int i = 0; i < 8; ++i) {
    const Vec2 x = turn * corners[i];
    geo << "Point(" << i + 1 << ") = {" << x.x() << ", " << x.y() << ", 0};\n";
  }
  for (int i = 0; i < 8; ++i)
    geo << "Line(" << i + 1 << ") = {" << i + 1 << ", " << (i % 4 == 3 ? i - 2 : i + 2) << "};\n";
  return geo.str();
}

/// On meshes that do not match; each side has its name.
inline const std::string unlike_blocks = R"(
Mesh.ElementOrder = 2;
Transfinite Curve{1, 3} = 6; Transfinite Curve{2, 4} = 4;
Transfinite Curve{5, 7} = 9; Transfinite Curve{6, 8} = 3;
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("bottom") = {1}; Physical Curve("lower_right") = {2};
Physical Curve("lower_contact") = {3}; Physical Curve("lower_left") = {4};
Physical Curve("upper_contact") = {5}; Physical Curve("upper_right") = {6};
Physical Curve("top") = {7}; Physical Curve("upper_left") = {8};
)";

/// Solved and estimated: rectangles of E = 1000 between sliding sides, pressed together by 1. `geo`: what draws them;
/// `contact`: of that entry, after its curves; `rest`: of the scene.
inline Results pressed_blocks(const std::string& geo, const std::string& contact, const std::string& rest = "") {
  const TemporaryFolder folder;
  folder.write("blocks.geo", "SetFactory(\"OpenCASCADE\");\n" + geo + R"(
Transfinite Surface{1, 2};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2}; Physical Curve("bottom") = {1};
Physical Curve("sides") = {2, 4, 6, 8}; Physical Curve("lower_contact") = {3}; Physical Curve("upper_contact") = {5};
Physical Curve("top") = {7};)");
  Results r = solve_scene(read_scene(folder.write("scene.toml", R"(mesh.file = "blocks.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { lower = "m", upper = "m" }
boundary = [{ on = "bottom", displacement = { y = 0 } }, { on = "sides", displacement = { x = 0 } },
  { on = "top", pressure = 1 }]
contact = [{ between = ["upper_contact", "lower_contact"], )" + contact +
                                                                    " }]\n" + rest)));
  estimate(r);
  return r;
}

}  // namespace mortise::test
