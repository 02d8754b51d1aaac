// A TOML document as a plain tree in which every value remembers where it was written.
#pragma once

#include "scene/node.hpp"

namespace mortise::scene_file {

/// Parses the text of a scene file. Throws InputError with file, line and what TOML expected, and where a key has more
/// than 32 parts.
Node parse_document(const std::string& text, const std::string& file);

/// The value that the right-hand side of an override stands for: a TOML value (number, bool, quoted string, list,
/// inline table) if it is one, else the text itself as a string. It takes name and path of `spot`, where it will stand.
Node parse_value(const std::string& text, const Node& spot, const Place& place);

/// The parts of a dotted TOML key (quoted parts may contain dots); empty if `key` is not one, or has more
/// than 32.
std::vector<std::string> split_key(const std::string& key);

/// "PATH.NAME", or NAME at the top of the document.
std::string join_path(const std::string& path, const std::string& name);

}  // namespace mortise::scene_file
