// Element sizes over the plane, from which a mesh is made.
#pragma once

#include "mesh/box_index.hpp"
#include "mesh/layered_sizes.hpp"
#include "mesh/mesh.hpp"

namespace mortise {

/// Sizes at the vertices of a mesh, linear over its triangles (quadrilaterals are cut in two); outside the mesh those
/// of the nearest one. Where two bodies meet or overlap, and under layers, the least. `sizes`: one a node, length;
/// those of second-order nodes are not looked at.
class SizeField {
 public:
  SizeField(const Mesh& mesh, const VecX& sizes, std::vector<SizeLayers> layers);

  double operator()(const Vec2& x) const;

 private:
  struct Triangle {
    std::array<Vec2, 3> x;
    std::array<double, 3> size;
    int body;
  };
  explicit SizeField(std::vector<Triangle> triangles, std::vector<SizeLayers> layers);
  static std::vector<Triangle> triangles_of(const Mesh& mesh, const VecX& sizes);

  std::vector<Triangle> triangles_;
  LayeredSizes layers_;
  BoxIndex boxes_;  // of the triangles
};

/// Lowers sizes at vertices until along no side of a cell they grow by more than `growth` times its length.
void limit_growth(const Mesh& mesh, double growth, VecX& sizes);

}  // namespace mortise
