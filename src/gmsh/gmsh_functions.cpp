// The module's own side of gmsh_module.hpp.
#include <dlfcn.h>
#include <gmsh.h>

#include <filesystem>

#include "gmsh/far_geometry.hpp"
#include "gmsh/free_mesh.hpp"
#include "gmsh/gmsh_data.hpp"
#include "gmsh/gmsh_module.hpp"
#include "gmsh/gmsh_session.hpp"

namespace mortise {
namespace {

MeshData mesh_geo(const std::string& file, const std::map<std::string, double>& parameters, ForbiddenBy forbidden) {
  GmshSession session(forbidden);
  session.read(file, parameters);
  if (std::filesystem::path(file).extension() == ".msh" || session.has_cells()) return gmsh_data(file);
  const Vec2 shift = move_to_origin(session, file);
  session.run(file, "meshing", [] { gmsh::model::mesh::generate(2); });
  MeshData data = gmsh_data(file);
  move(-shift, data);
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
