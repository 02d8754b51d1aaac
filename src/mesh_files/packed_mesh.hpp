// Meshes as bytes: between processes of one run, and kept from run to run.
#pragma once

#include <string>
#include <string_view>

#include "base/packed.hpp"
#include "mesh_files/mesh_data.hpp"

namespace mortise {

void put_groups(Packed& to, const std::vector<PhysicalGroup>& groups);
std::vector<PhysicalGroup> take_groups(Unpacked& from);

/// All of it but the file's name and what is only known of mesh files (notes, named_by_tag).
std::string packed_mesh(const MeshData& data);

/// Throws std::out_of_range where the bytes are not those of a mesh: too few, nodes that are not there, kinds of
/// elements that gmsh does not have.
MeshData unpacked_mesh(std::string_view bytes);

}  // namespace mortise
