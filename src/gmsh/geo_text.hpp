// The text of a .geo, searched for words of its language without reading it as gmsh does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mortise {

struct GeoText {
  std::filesystem::path file;
  std::string text;
  std::string code;  ///< the text with comments and the insides of strings as spaces: all else keeps its place
};

/// Throws InputError if the file cannot be read.
GeoText read_geo_text(const std::filesystem::path& file);

/// Positions just behind each occurrence of the whole word in the code.
std::vector<std::size_t> ends_of_word(const std::string& code, const std::string& word);

std::size_t skip_spaces(const std::string& code, std::size_t i);
std::size_t skip_word(const std::string& code, std::size_t i);

/// Position behind the bracket that closes the one at `i`; the end of the code if none does.
std::size_t skip_brackets(const std::string& code, std::size_t i);

/// The files that are read by Include, Merge and the like; empty where the name is not a plain string.
std::vector<std::filesystem::path> included_files(const GeoText& geo);

}  // namespace mortise
