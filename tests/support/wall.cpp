#include "support/wall.hpp"

#include <sstream>

namespace mortise::test {
namespace {

std::string block_name(int i, int j) {
  std::ostringstream name;
  name << "b" << i << "_" << j;
  return name.str();
}

Mesh mesh_of_wall(int n, int elements) {
  std::vector<Patch> blocks;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int m = elements + (i + j) % 2;
      const double size = 1.0 / n;
      blocks.push_back(block(
          block_name(i, j), m, m, i * size, (i + 1) * size, [=](double) { return j * size; },
          [=](double) { return (j + 1) * size; }));
    }
  return mesh_of(blocks, CellKind::quad8);
}

BoundarySpec boundary(const std::string& on, BoundaryCondition what) {
  return {.key = "boundary", .on = {on}, .what = std::move(what)};
}

}  // namespace

Wall wall(int n, int elements) {
  Wall w{mesh_of_wall(n, elements), {}};
  w.scene.path = "wall";
  w.scene.materials["stone"] = {10e9, 0.2, 0};
  const auto add_pair = [&](const std::string& first, const std::string& second) {
    ContactSpec contact;
    contact.key = std::string("contact.") + std::to_string(w.scene.contacts.size());
    contact.between = {first, second};
    contact.initial_gap = InitialGap::closed;
    w.scene.contacts.push_back(contact);
  };
  const auto slide = [&](const std::string& on, std::optional<double> y = {}) {
    w.scene.boundaries.push_back(boundary(on, Displacement{0, y}));
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::string name = block_name(i, j);
      w.scene.bodies.push_back({name, "stone"});
      if (i + 1 < n) add_pair(name + "_east", block_name(i + 1, j) + "_west");
      if (j + 1 < n) add_pair(name + "_north", block_name(i, j + 1) + "_south");
      if (i == 0) slide(name + "_west");
      if (i + 1 == n) slide(name + "_east");
      if (j == 0) slide(name + "_south", 0);
      if (j + 1 == n) {
        w.scene.boundaries.push_back(boundary(name + "_north", Pressure{1e6 * (1 + i % 3)}));
      }
    }
  return w;
}

}  // namespace mortise::test
