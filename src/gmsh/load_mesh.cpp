#include "gmsh/load_mesh.hpp"

#include <filesystem>

#include "base/errors.hpp"
#include "gmsh/geo_file.hpp"
#include "gmsh/gmsh_process.hpp"
#include "gmsh/mesh_cache.hpp"
#include "mesh_files/assemble_mesh.hpp"
#include "mesh_files/bdf_file.hpp"
#include "mesh_files/inp_file.hpp"
#include "mesh_files/mesh_groups.hpp"
#include "mesh_files/msh_file.hpp"
#include "mesh_files/set_mesh.hpp"
#include "mesh_files/unv_file.hpp"
#include "model/mesh_endings.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

bool is_geo(const std::string& file) { return fs::path(file).extension() == ".geo"; }

/// The files that are meshes already.
MeshData read_mesh_file(const std::string& file) {
  const fs::path ending = fs::path(file).extension();
  if (ending == ".inp") return data_of_sets(read_inp(file));
  if (ending == ".unv") return data_of_sets(read_unv(file));
  if (ending == ".bdf" || ending == ".nas") return data_of_sets(read_bdf(file));
  MeshData data = read_msh(file);
  group_by_entity(data);
  return data;
}

MeshData load_data(const std::string& file, const std::map<std::string, double>& parameters, const GeoLimits& limits,
                   bool* cached) {
  check_mesh_file(file, parameters);
  if (!is_geo(file)) return read_mesh_file(file);
  const auto key = [&] { return mesh_cache_on() ? mesh_key(file, parameters) : std::nullopt; };
  const std::optional<std::string> before = key();
  std::optional<MeshData> kept = before ? cached_mesh(*before) : std::nullopt;
  GmshProcess gmsh(file, limits);
  MeshData data = kept ? *std::move(kept) : gmsh.mesh_geo(parameters);
  if (before && !kept && !gmsh.acts() && key() == before) keep_mesh(*before, gmsh_module().files(), data);
  data.file = file;
  if (cached) *cached = kept.has_value();
  return data;
}

}  // namespace

void check_mesh_file(const std::string& file, const std::map<std::string, double>& parameters) {
  if (!is_mesh_ending(fs::path(file).extension().string())) {
    throw InputError(file + ": a mesh file ends in " + mesh_endings_in_words + mesh_ending_advice(file));
  }
  std::error_code error;
  if (!fs::is_regular_file(file, error)) throw InputError(file + ": no such file");
  if (is_geo(file)) {
    told_with_key("mesh.parameters", [&] { check_geo(file, parameters); });
  } else if (!parameters.empty()) {
    throw SceneError("mesh.parameters: " + file + ": parameter '" + parameters.begin()->first +
                     "' given to a mesh; only a .geo has parameters");
  }
}

Mesh load_mesh(const std::string& file, const std::map<std::string, double>& parameters, const GeoLimits& limits,
               bool* cached) {
  return assemble_mesh(load_data(file, parameters, limits, cached));
}

Mesh load_all_named(const std::string& file, const GeoLimits& limits) {
  MeshData data = load_data(file, {}, limits, nullptr);
  group_the_rest(data);
  return assemble_mesh(std::move(data));
}

}  // namespace mortise
