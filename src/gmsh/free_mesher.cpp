#include "gmsh/free_mesher.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/errors.hpp"
#include "base/stopwatch.hpp"
#include "fem/elements.hpp"
#include "gmsh/flat_triangles.hpp"
#include "gmsh/load_mesh.hpp"
#include "mesh_files/assemble_mesh.hpp"

namespace mortise {

FreeMesher::FreeMesher(const std::string& file, const std::map<std::string, double>& parameters,
                       const GeoLimits& limits)
    : gmsh_(file, limits), limit_(limits.seconds) {
  check_mesh_file(file, parameters);
  if (std::filesystem::path(file).extension() != ".geo")
    throw InputError(file + ": a mesh has no geometry to refine; expected a .geo");
  drawing_ = gmsh_.read_drawing(parameters);
}

Mesh FreeMesher::mesh_once(const SizeAt& size, bool recombine, double seconds) {
  const Stopwatch watch;
  MeshData data = gmsh_.mesh_freely(drawing_.geometry, size, recombine, seconds);
  slowest_ = std::max(slowest_, watch.elapsed() / double(data.nodes.size()));
  swap_flat_triangles(data);
  Mesh mesh = assemble_mesh(std::move(data));
  check_cells(mesh);
  return mesh;
}

// gmsh 4.8 leaves inverted triangles where a curve turns within an edge, and flat ones that no swap mends; other sizes
// a little smaller avoid them. Where it makes quadrilaterals of edges far shorter than the next, those are inverted at
// many sizes: triangles then.
Mesh FreeMesher::mesh(const SizeAt& size, bool recombine, double nodes) {
  constexpr int attempts = 6, with_quadrilaterals = 2;
  // A machine that is busy, or more nodes than expected, makes no mesh ten times slower; nor one of a few nodes, which
  // takes 0.05 s, as slow as 3 s.
  constexpr double slower = 10, least_seconds = 3;
  const double seconds = nodes > 0 ? std::min(limit_, std::max(least_seconds, slower * slowest_ * nodes)) : limit_;
  double part = 1;
  for (int attempt = 1;; ++attempt, part *= 0.9) {
    try {
      return mesh_once([&](const Vec2& x) { return part * size(x); }, recombine && attempt <= with_quadrilaterals,
                       attempt < attempts ? seconds : limit_);
    } catch (const InputError&) {
      if (attempt == attempts) throw;
    }
  }
}

}  // namespace mortise
