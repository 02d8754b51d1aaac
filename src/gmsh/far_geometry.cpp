#include "gmsh/far_geometry.hpp"

#include <gmsh.h>

#include <algorithm>

#include "base/memory_file.hpp"
#include "gmsh/sandbox.hpp"

namespace mortise {
namespace {

bool drawn_by_gmsh() {
  gmsh::vectorpair surfaces, opencascade;
  gmsh::model::occ::getEntities(opencascade);
  gmsh::model::getEntities(surfaces, 2);
  const auto is_drawn = [](const std::pair<int, int>& surface) {
    std::string type;
    gmsh::model::getType(surface.first, surface.second, type);
    return type != "Discrete surface";
  };
  return !surfaces.empty() && opencascade.empty() && std::ranges::all_of(surfaces, is_drawn);
}

}  // namespace

bool lies_far(const Box& box) { return box.center().norm() > box.diagonal().norm(); }

// To a path without an extension gmsh writes a .geo only by Save.
std::string unrolled(GmshSession& session, const std::string& file) {
  constexpr int as_geo = 8;
  const MemoryFile output;
  const MemoryFile script("Save \"" + output.path() + "\";\n");
  gmsh::option::setNumber("Mesh.Format", as_geo);
  gmsh::option::setNumber("Print.GeoLabels", 0);  // with names instead of tags the groups would be numbered anew
  gmsh::option::setNumber("Print.GeoOnlyPhysicals", 0);
  const WritingInto memory(output.descriptor());
  session.run(file, "writing its geometry", [&] { gmsh::merge(script.path()); });
  return output.text();
}

Vec2 move_to_origin(GmshSession& session, const std::string& file) {
  if (!drawn_by_gmsh()) return Vec2::Zero();
  double z = 0;
  Vec2 low, high;
  gmsh::model::getBoundingBox(-1, -1, low.x(), low.y(), z, high.x(), high.y(), z);
  const Box box(low, high);
  if (!lies_far(box) || unrolled(session, file).find("Field[") != std::string::npos) return Vec2::Zero();
  const Vec2 centre = box.center();
  gmsh::option::setNumber("Geometry.AutoCoherence", 0);  // else gmsh makes one of points and arcs that lie in one place
  gmsh::vectorpair all;
  gmsh::model::getEntities(all);
  session.run(file, "moving it to the origin", [&] {
    gmsh::model::geo::translate(all, -centre.x(), -centre.y(), 0);
    gmsh::model::geo::synchronize();
  });
  return -centre;
}

}  // namespace mortise
