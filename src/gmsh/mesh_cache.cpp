#include "gmsh/mesh_cache.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "base/packed.hpp"
#include "gmsh/geo_file.hpp"
#include "mesh_files/packed_mesh.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_cache = 512 << 20;  // bytes

/// Tells one state of a file from another without reading it.
std::string stamp(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return std::to_string(size) + " " + std::to_string(fs::last_write_time(file, error).time_since_epoch().count());
}

std::optional<std::string> bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  if (!(bytes << stream.rdbuf())) return std::nullopt;
  return std::move(bytes).str();
}

/// Whether it is a regular file of this user's: in a folder that several share others may put pipes, links and meshes
/// of their own.
bool is_own_file(const fs::path& file) {
  struct stat status {};
  return ::lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid();
}

/// Empty if the user has none.
fs::path folder() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "mortise";
  const char* const home = std::getenv("HOME");
  return home && fs::path(home).is_absolute() ? fs::path(home) / ".cache" / "mortise" : fs::path();
}

fs::path entry_of(const std::string& key) {
  std::ostringstream name;
  name << std::hex << std::hash<std::string>{}(key) << ".mesh";
  return folder() / name.str();
}

void remove_oldest() {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t size;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::uintmax_t sum = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(folder())) {
    if (!is_own_file(file.path())) continue;
    entries.push_back({file.last_write_time(), file.file_size(), file.path()});
    sum += entries.back().size;
  }
  std::ranges::sort(entries, {}, &Entry::used);
  for (auto entry = entries.begin(); sum > largest_cache; ++entry) {
    fs::remove(entry->path);
    sum -= entry->size;
  }
}

bool is_on = false;

}  // namespace

void set_mesh_cache(bool on) { is_on = on; }
bool mesh_cache_on() { return is_on; }

std::optional<std::string> mesh_key(const std::string& file, const std::map<std::string, double>& parameters) {
  const std::optional<std::vector<fs::path>> sources = geo_sources(file);
  if (!sources || folder().empty()) return std::nullopt;
  Packed key;
  key.put(std::string(MORTISE_VERSION));
  key.put(stamp("/proc/self/exe"));
  for (const auto& [name, value] : parameters) {
    key.put(name);
    key.put(&value, 1);
  }
  for (const fs::path& source : *sources) {
    const std::optional<std::string> text = bytes_of(source);
    if (!text) return std::nullopt;
    key.put(*text);
  }
  return key.bytes;
}

// An entry: a hash of all that follows; how many files gmsh was loaded from, their names and stamps; the key; the mesh.
std::optional<MeshData> cached_mesh(const std::string& key) {
  const fs::path path = entry_of(key);
  const std::optional<std::string> bytes = is_own_file(path) ? bytes_of(path) : std::nullopt;
  if (!bytes || bytes->size() < sizeof(std::int64_t)) return std::nullopt;
  const std::string_view content = std::string_view(*bytes).substr(sizeof(std::int64_t));
  try {
    const auto hash = static_cast<std::size_t>(Unpacked(*bytes).number());
    if (hash != std::hash<std::string_view>{}(content)) return std::nullopt;
    Unpacked from(content);
    for (std::int64_t count = from.number(); count > 0; --count) {
      const std::string file = from.text();
      if (from.text() != stamp(file)) return std::nullopt;
    }
    if (from.text() != key) return std::nullopt;
    std::error_code ignored;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    return unpacked_mesh(from.rest());
  } catch (const std::exception&) {  // another program's file of that name
    return std::nullopt;
  }
}

void keep_mesh(const std::string& key, const std::vector<std::string>& made_by, const MeshData& data) {
  Packed content;
  content.put(std::ssize(made_by));
  for (const std::string& file : made_by) {
    content.put(file);
    content.put(stamp(file));
  }
  content.put(key);
  content.bytes += packed_mesh(data);
  if (content.bytes.size() > largest_cache / 4) return;
  try {
    const fs::path path = entry_of(key), staging = path.string() + "." + std::to_string(::getpid());
    fs::create_directories(folder());
    Packed hash;
    hash.put(static_cast<std::int64_t>(std::hash<std::string>{}(content.bytes)));
    std::ofstream stream(staging, std::ios::binary);
    stream << hash.bytes << content.bytes;
    stream.close();
    std::error_code error;
    if (stream) fs::rename(staging, path, error);
    if (!stream || error) fs::remove(staging);
    remove_oldest();
  } catch (const fs::filesystem_error&) {  // no room, no right, or another run removes files too
  }
}

}  // namespace mortise
