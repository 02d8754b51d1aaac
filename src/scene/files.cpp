#include "scene/files.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "base/errors.hpp"
#include "scene/fail.hpp"

namespace mortise::scene_file {
namespace {

namespace fs = std::filesystem;

std::string nearest_file(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path{"."};
  std::vector<std::string> candidates;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == path.extension()) candidates.push_back(entry->path().filename().string());
  }
  // The order of a folder is the file system's; sorted, the answer is the same everywhere.
  std::sort(candidates.begin(), candidates.end());
  return nearest_name(path.filename().string(), candidates);
}

}  // namespace

std::string file_trouble(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return "is a folder; expected a file";
  if (fs::exists(status)) return {};
  if (status.type() != fs::file_type::not_found) return "cannot be looked at: " + error.message();
  const std::string nearest = nearest_file(path);
  return "no such file" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    Place place;
    place.file = path.string();
    fail(place, "", "cannot be read; expected a readable file");
  }
  return text;
}

}  // namespace mortise::scene_file
