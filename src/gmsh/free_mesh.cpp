#include "gmsh/free_mesh.hpp"

#include <gmsh.h>

#include <array>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "gmsh/gmsh_data.hpp"
#include "gmsh/gmsh_session.hpp"

namespace mortise {
namespace {

void set_mesh_options(bool recombine) {
  const std::vector<std::pair<const char*, double>> options{
      {"Mesh.Algorithm", 6},  // Frontal-Delaunay
      {"Mesh.ElementOrder", 2},
      {"Mesh.SecondOrderIncomplete", 1},
      {"Mesh.SecondOrderLinear", 0},
      {"Mesh.HighOrderOptimize", 0},
      {"Mesh.MeshSizeFromPoints", 0},
      {"Mesh.MeshSizeFromCurvature", 0},
      {"Mesh.MeshSizeExtendFromBoundary", 0},
      {"Mesh.SmoothRatio", 1e4},  // of lengths along curves, which may grow as asked
      {"Mesh.MinimumCircleNodes", 0},
      {"Mesh.MinimumCurveNodes", 0},
      {"Mesh.LcIntegrationPrecision", 1e-5},  // of a count of edges; less gives the same meshes, later
      {"Mesh.RecombineAll", recombine ? 1 : 0},
  };
  for (const auto& [name, value] : options) gmsh::option::setNumber(name, value);
}

/// While it lives, gmsh's only sizes: it takes the least of all that it is given, and is given no others.
class SizeCallback {
 public:
  /// `failure`: takes what the function throws, which must not go through gmsh.
  SizeCallback(const SizeAt& size, std::exception_ptr& failure) : size_(size), failure_(failure) {
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    for (const auto& [dimension, curve] : curves) factors_[curve] = speed_factor(curve);
    gmsh::model::mesh::setSizeCallback(
        [this](int dimension, int tag, double x, double y, double) { return answer(dimension, tag, Vec2(x, y)); });
  }
  ~SizeCallback() { gmsh::model::mesh::removeSizeCallback(); }
  SizeCallback(const SizeCallback&) = delete;
  SizeCallback& operator=(const SizeCallback&) = delete;

 private:
  double answer(int dimension, int tag, const Vec2& x) {
    constexpr double coarse = 1e22;  // gmsh's largest; lets it come to an end soon
    if (failure_) return coarse;
    try {
      const double size = size_(x);
      if (!(size > 0)) throw std::domain_error("mesh size " + std::to_string(size) + " " + near_point(x));
      return dimension == 1 ? size * factors_.at(tag) : size;
    } catch (...) {
      failure_ = std::current_exception();
      return coarse;
    }
  }

  const SizeAt& size_;
  std::map<int, double> factors_;  // by curve
  std::exception_ptr& failure_;
};

// By what part of the whole gmsh moves the points of curves before it triangulates them, lest any be in line. Where it
// takes rows of short edges for identical points all the same, or then misses some of these edges, it is ten times as
// much; 1e-9 flattens triangles at tiny edges.
constexpr std::array random_parts{1e-13, 1e-12, 1e-11, 1e-10};

bool asks_for_more(const InputError& error) {
  const std::string_view said = error.what();
  return said.find("Identical points") != said.npos || said.find("Unable to recover the edge") != said.npos;
}

void generate(GmshSession& session, const std::string& file, const SizeAt& size) {
  std::exception_ptr failure;
  for (const double part : random_parts) try {
      gmsh::option::setNumber("Mesh.RandomFactor", part);
      session.run(file, "meshing", [&] {
        gmsh::model::mesh::clear();
        const SizeCallback callback(size, failure);
        gmsh::model::mesh::generate(2);
      });
      break;
    } catch (const InputError& error) {
      if (failure) break;
      if (part == random_parts.back() || !asks_for_more(error)) throw;
    }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

MeshData mesh_freely(const FreeGeometry& geometry, const SizeAt& size, bool recombine, ForbiddenBy forbidden) {
  GmshSession session(forbidden);
  open_free_geometry(session, geometry);
  set_mesh_options(recombine);
  generate(session, geometry.file, [&](const Vec2& x) { return size(x - geometry.shift); });
  return gmsh_data(geometry.file, geometry.shift);
}

}  // namespace mortise
