// Scenes drawn for the audit, and what it says of them.
#pragma once

#include <algorithm>

#include "app/solve_scene.hpp"
#include "results/audit_solution.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {

// A scene made by gmsh's OpenCASCADE kernel: `bodies` are its physical surfaces, all of steel.
inline Scene drawn(const TemporaryFolder& folder, const std::string& geo, const std::vector<std::string>& bodies,
                   const std::string& rest) {
  folder.write("s.geo", "SetFactory(\"OpenCASCADE\"); Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.2;\n" + geo);
  std::string toml = "[mesh]\nfile = \"s.geo\"\n[materials.steel]\nyoung = 210e3\npoisson = 0.3\n[bodies]\n";
  for (const std::string& body : bodies) toml += body + " = \"steel\"\n";
  return read_scene(folder.write("s.toml", toml + rest));
}

inline std::string boundary(const std::string& on, const std::string& what) {
  return "[[boundary]]\non = [\"" + on + "\"]\n" + what + "\n";
}
inline std::string held(const std::string& on) { return boundary(on, "displacement = { x = 0, y = 0 }"); }
inline std::string pair(const std::string& a, const std::string& b) {
  return "[[contact]]\nbetween = [\"" + a + "\", \"" + b + "\"]\n";
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

inline std::string before(const Scene& scene) { return joined(check_scene(scene).warnings); }
inline std::string after(const Scene& scene) { return joined(audit_solution(solve_scene(scene))); }

inline int lines_of(const std::string& text) { return int(std::count(text.begin(), text.end(), '\n')); }

// Rectangles i = 1, 2, ...: x, y, width, height. Surfaces b1, ..; curves down1, right1, up1, left1, ..
inline std::string rectangles(const std::vector<std::string>& boxes) {
  std::string geo;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::string n = std::to_string(i + 1);
    geo += "Rectangle(" + n + ") = {" + boxes[i] + "}; c" + n + "() = Boundary{ Surface{" + n + "}; };\n";
    geo += "Physical Surface(\"b" + n + "\") = {" + n + "};\n";
    const char* sides[] = {"down", "right", "up", "left"};
    for (int k = 0; k < 4; ++k)
      geo += std::string("Physical Curve(\"") + sides[k] + n + "\") = {c" + n + "(" + std::to_string(k) + ")};\n";
  }
  return geo;
}

}  // namespace mortise::test
