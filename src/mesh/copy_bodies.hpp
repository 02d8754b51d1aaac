// Many bodies from the meshes of a few.
#pragma once

#include "mesh/mesh.hpp"
#include "model/body_copy.hpp"

namespace mortise {

/// The mesh with copies in the place of the bodies that are copied: first the bodies that are not, then the copies in
/// their order, nodes and cells of each in the order of its original. The curve "block_top" of a body "block" is
/// "block_3_top" of its copy "block_3", and so is "top"; of a curve of several bodies each copy has its own body's
/// part. Points are named alike. Throws SceneError with the copy's key: an unknown body, one that shares nodes with
/// another, a name that is taken.
Mesh copy_bodies(Mesh mesh, const std::vector<BodyCopy>& copies);

}  // namespace mortise
