#include "io/gmsh_mesh.hpp"

#include <filesystem>

#include "base/errors.hpp"
#include "io/assemble_mesh.hpp"
#include "io/geo_file.hpp"
#include "io/gmsh_data.hpp"
#include "io/gmsh_guard.hpp"
#include "io/gmsh_session.hpp"
#include "io/msh_file.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

bool is_msh(const std::string& file) { return fs::path(file).extension() == ".msh"; }

}  // namespace

void check_mesh_file(const std::string& file, const std::map<std::string, double>& parameters,
                     const GeoLimits& limits) {
  if (!is_msh(file) && fs::path(file).extension() != ".geo") {
    throw InputError(file + ": a mesh file ends in .geo or .msh");
  }
  std::error_code error;
  if (!fs::is_regular_file(file, error)) throw InputError(file + ": no such file");
  if (!is_msh(file)) {
    check_geo(file, parameters, limits.programs);
  } else if (!parameters.empty()) {
    throw InputError(file + ": parameter '" + parameters.begin()->first +
                     "' given to a mesh; only a .geo has parameters");
  }
}

Mesh load_mesh(const std::string& file, const std::map<std::string, double>& parameters, const GeoLimits& limits) {
  check_mesh_file(file, parameters, limits);
  if (is_msh(file)) return assemble_mesh(read_msh(file));
  MeshData data;
  {
    const GmshGuard guard(file, limits.seconds);
    GmshSession session;
    session.open(file, parameters);
    data = gmsh_data(file);
  }
  return assemble_mesh(std::move(data));
}

}  // namespace mortise
