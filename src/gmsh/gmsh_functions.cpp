// The module's own side of gmsh_module.hpp.
#include <dlfcn.h>
#include <gmsh.h>

#include <filesystem>
#include <map>

#include "gmsh/compound_curves.hpp"
#include "gmsh/far_geometry.hpp"
#include "gmsh/free_mesh.hpp"
#include "gmsh/gmsh_data.hpp"
#include "gmsh/gmsh_groups.hpp"
#include "gmsh/gmsh_module.hpp"
#include "gmsh/gmsh_session.hpp"

namespace mortise {
namespace {

std::map<int, std::vector<int>> groups_of_curves() {
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  std::map<int, std::vector<int>> groups;
  for (const auto& [dimension, tag] : curves) groups[tag] = groups_of_entity(dimension, tag);
  return groups;
}

// Compounds appear as surfaces are meshed, and take the groups of their members with them.
CompoundCurves compound_curves(const std::map<int, std::vector<int>>& drawn) {
  CompoundCurves found;
  for (const auto& [tag, groups] : groups_of_curves()) {
    const auto before = drawn.find(tag);
    if (before == drawn.end())
      found.compounds.push_back(tag);
    else if (before->second != groups)
      found.members.push_back(tag);
  }
  return found;
}

MeshData mesh_geo(const std::string& file, const std::map<std::string, double>& parameters, ForbiddenBy forbidden) {
  GmshSession session(forbidden);
  session.read(file, parameters);
  if (std::filesystem::path(file).extension() == ".msh" || session.has_cells()) return gmsh_data(file, Vec2::Zero());
  const Vec2 shift = move_to_origin(session, file);
  const std::map<int, std::vector<int>> drawn = groups_of_curves();
  session.run(file, "meshing", [] { gmsh::model::mesh::generate(2); });
  MeshData data = gmsh_data(file, shift, drawn);
  leave_compounds(compound_curves(drawn), data);
  return data;
}

FreeDrawing read_drawing(const std::string& file, const std::map<std::string, double>& parameters,
                         ForbiddenBy forbidden) {
  GmshSession session(forbidden);
  FreeDrawing drawing{read_free_geometry(session, file, parameters), {}};
  session.run(file, "sampling its curves", [&] { drawing.curves = drawn_curves(); });
  return drawing;
}

std::vector<std::string> files() {
  std::vector<std::string> names;
  for (const void* symbol : {reinterpret_cast<const void*>(&mesh_geo), reinterpret_cast<const void*>(&gmsh::open)})
    if (Dl_info info; ::dladdr(symbol, &info) != 0) names.emplace_back(info.dli_fname);
  return names;
}

}  // namespace
}  // namespace mortise

extern "C" [[gnu::visibility("default")]] const mortise::GmshModule mortise_gmsh;
const mortise::GmshModule mortise_gmsh{mortise::mesh_geo, mortise::read_drawing, mortise::mesh_freely, mortise::files};
