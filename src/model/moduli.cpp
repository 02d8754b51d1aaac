#include "model/moduli.hpp"

#include <cmath>

namespace mortise {

std::optional<Mat4> orthotropic_stiffness(const OrthotropicModuli& m) {
  Mat4 compliance;
  compliance << 1 / m.e1, -m.nu12 / m.e1, -m.nu13 / m.e1, 0,  //
      -m.nu12 / m.e1, 1 / m.e2, -m.nu23 / m.e2, 0,            //
      -m.nu13 / m.e1, -m.nu23 / m.e2, 1 / m.e3, 0,            //
      0, 0, 0, 1 / m.g12;
  if (!is_stiffness(compliance)) return {};
  // Strains along the material's directions of those along the axes.
  const double c = std::cos(m.angle), s = std::sin(m.angle);
  Mat4 turned;
  turned << c * c, s * s, 0, c * s,  //
      s * s, c * c, 0, -c * s,       //
      0, 0, 1, 0,                    //
      -2 * c * s, 2 * c * s, 0, c * c - s * s;
  return turned.transpose() * inverse(compliance) * turned;
}

bool is_stiffness(const Mat4& stiffness) { return stiffness.allFinite() && stiffness.llt().info() == Eigen::Success; }

}  // namespace mortise
