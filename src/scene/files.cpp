#include "scene/files.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>
#include <vector>

#include "base/errors.hpp"
#include "scene/fail.hpp"
#include "scene/fields.hpp"

namespace mortise::scene_file {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_scene = 4'000'000;  // characters

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

fs::path resolve(const Node& file, const std::string& scene_path) {
  const fs::path path{name(file)};
  if (!file.place.setting.empty()) return path;
  return (fs::path{scene_path}.parent_path() / path).lexically_normal();
}

std::string file_trouble(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return "is a folder; expected a file";
  if (fs::is_regular_file(status)) return {};
  if (fs::exists(status)) return "is a device or a pipe; expected a file";
  if (status.type() != fs::file_type::not_found) return "cannot be looked at: " + error.message();
  const std::string nearest = nearest_file(path);
  return "no such file" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

void require_file(const Node& file, const fs::path& path) {
  if (const std::string trouble = file_trouble(path); !trouble.empty())
    fail(file, "'" + path.string() + "': " + trouble);
}

std::string read_text(const fs::path& path) {
  Place place;
  place.file = path.string();
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  for (std::array<char, 16384> piece{}; stream && text.size() <= largest_scene;) {
    stream.read(piece.data(), piece.size());
    text.append(piece.data(), stream.gcount());
  }
  if (!stream.is_open() || stream.bad()) fail(place, "", "cannot be read; expected a readable file");
  if (text.size() > largest_scene) fail(place, "", "is larger than 4 MB; expected a scene file, a page or two of text");
  return text;
}

}  // namespace mortise::scene_file
