// Meshes that gmsh has made of a .geo, kept in the user's cache folder: the same geometry with the same parameters is
// not meshed twice.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Whether load_mesh keeps meshes and takes kept ones: off until it is switched on, as the command line does.
void set_mesh_cache(bool on);
bool mesh_cache_on();

/// All that the mesh of a .geo depends on: the texts of all its files, the parameters, the program. Empty where that
/// cannot be known (geo_sources).
std::optional<std::string> mesh_key(const std::string& file, const std::map<std::string, double>& parameters);

/// The mesh that was kept under that key by gmsh as it is now, if there is one and it is whole. Without a file's name.
std::optional<MeshData> cached_mesh(const std::string& key);

/// Keeps it, in one step, and removes the entries that were not used for longest where all are more than 512 MB.
/// `made_by`: the files that gmsh was loaded from. Where the folder cannot be written nothing happens.
void keep_mesh(const std::string& key, const std::vector<std::string>& made_by, const MeshData& data);

}  // namespace mortise
