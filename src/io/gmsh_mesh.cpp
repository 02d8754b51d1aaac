#include "io/gmsh_mesh.hpp"

#include <filesystem>

#include "base/errors.hpp"
#include "io/assemble_mesh.hpp"
#include "io/geo_file.hpp"
#include "io/gmsh_data.hpp"
#include "io/gmsh_guard.hpp"
#include "io/gmsh_session.hpp"
#include "io/msh_file.hpp"
#include "io/staged_file.hpp"

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

void check_msh_target(const std::string& output, const std::vector<std::string>& inputs) {
  if (!is_msh(output)) throw InputError(output + ": the name of a mesh to write ends in .msh");
  std::vector<fs::path> all;
  for (const std::string& input : inputs) {
    all.emplace_back(input);
    if (fs::path(input).extension() != ".geo") continue;
    for (const fs::path& read : geo_inputs(input)) all.push_back(read);
  }
  check_target(output, all, [](const std::string& line) { return line == "$MeshFormat"; });
}

void write_msh(const std::string& file, const std::map<std::string, double>& parameters, const std::string& output,
               const GeoLimits& limits) {
  check_msh_target(output, {file});
  check_mesh_file(file, parameters, limits);
  if (is_msh(file)) assemble_mesh(read_msh(file));  // refuses what gmsh would not survive
  GmshGuard guard(file, limits.seconds);
  GmshSession session;
  session.open(file, parameters);
  write_open_mesh(session, guard, assemble_mesh(gmsh_data(file)), output);
}

void write_open_mesh(GmshSession& session, GmshGuard& guard, const Mesh& mesh, const std::string& output) {
  StagedFile staged(output);
  guard.remove_at_end(staged.path().string());
  session.write(staged.path().string());
  // gmsh does not ask whether the disk took what it wrote.
  const auto fail = [&](const std::string& why) { throw InputError(output + ": cannot be written: " + why); };
  try {
    const Mesh written = assemble_mesh(read_msh(staged.path().string()));
    if (written.nodes.rows() == mesh.nodes.rows() && written.cells.size() == mesh.cells.size()) return staged.commit();
  } catch (const InputError& error) {
    const std::string text = error.what();
    const std::size_t start = text.rfind(staged.path().string(), 0) == 0 ? staged.path().string().size() : 0;
    fail("what was written cannot be read back (is the disk full?)" + text.substr(start));
  }
  fail("what was written is not the whole mesh (is the disk full?)");
}

}  // namespace mortise
