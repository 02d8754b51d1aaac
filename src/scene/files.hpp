// Files that a user names: reading them, and what to say when they are not there.
#pragma once

#include <filesystem>
#include <string>

#include "scene/node.hpp"

namespace mortise::scene_file {

/// A file that the scene names: in the scene file relative to that file, on the command line relative to the working
/// directory.
std::filesystem::path resolve(const Node& file, const std::string& scene_path);

/// The fault of `path` as a file to read, with the nearest file of the same ending beside it; empty if nothing.
std::string file_trouble(const std::filesystem::path& path);

/// Throws InputError where `path`, which `file` names, is no file to read.
void require_file(const Node& file, const std::filesystem::path& path);

/// The whole text of a scene file. Throws InputError, naming the file, if it cannot be read or is larger than 4 MB.
std::string read_text(const std::filesystem::path& path);

}  // namespace mortise::scene_file
