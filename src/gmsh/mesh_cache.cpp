#include "gmsh/mesh_cache.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "gmsh/geo_file.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_cache = 512 << 20;  // bytes

/// Numbers, texts and lists one after the other.
class Packed {
 public:
  std::string bytes;

  void put(std::int64_t number) { append(&number, sizeof number); }
  void put(const std::string& text) { put(text.data(), text.size()); }
  template <typename Number>
  void put(const Number* first, std::size_t count) {
    put(static_cast<std::int64_t>(count));
    append(first, count * sizeof(Number));
  }

 private:
  void append(const void* from, std::size_t count) { bytes.append(static_cast<const char*>(from), count); }
};

/// Reads them again, in the same order. Throws std::out_of_range where they end too early.
class Unpacked {
 public:
  explicit Unpacked(std::string_view bytes) : bytes_(bytes) {}

  std::int64_t number() {
    std::int64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number())); }
  template <typename Number>
  std::vector<Number> list() {
    const std::string_view from = take(static_cast<std::size_t>(number()) * sizeof(Number));
    std::vector<Number> values(from.size() / sizeof(Number));
    if (!values.empty()) std::memcpy(values.data(), from.data(), from.size());
    return values;
  }

 private:
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) throw std::out_of_range("mesh cache");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view bytes_;
};

// Of each edge: how many pieces it has, its misfit; of each piece: its end, its places.
void pack(Packed& to, const std::vector<EdgeSamples>& edges) {
  std::vector<double> numbers;
  for (const EdgeSamples& edge : edges) {
    numbers.insert(numbers.end(), {double(edge.pieces.size()), edge.misfit});
    for (const SamplePiece& piece : edge.pieces) {
      numbers.push_back(piece.end);
      for (const Vec2& place : piece.places) numbers.insert(numbers.end(), {place.x(), place.y()});
    }
  }
  to.put(numbers.data(), numbers.size());
}

std::vector<EdgeSamples> unpack_samples(Unpacked& from) {
  const std::vector<double> numbers = from.list<double>();
  std::vector<EdgeSamples> edges;
  for (auto x = numbers.begin(); x != numbers.end();) {
    EdgeSamples& edge = edges.emplace_back();
    edge.pieces.resize(std::size_t(*x++));
    edge.misfit = *x++;
    for (SamplePiece& piece : edge.pieces) {
      piece.end = *x++;
      for (Vec2& place : piece.places) {
        place = Vec2(x[0], x[1]);
        x += 2;
      }
    }
  }
  return edges;
}

void pack(Packed& to, const ElementBlock& block) {
  for (const int number : {block.dimension, block.entity, block.type}) to.put(number);
  to.put(block.groups.data(), block.groups.size());
  to.put(block.nodes.data(), block.nodes.size());
  pack(to, block.samples);
  to.put(block.undrawn);
}

ElementBlock unpack_block(Unpacked& from) {
  ElementBlock block{};
  for (int* number : {&block.dimension, &block.entity, &block.type}) *number = static_cast<int>(from.number());
  block.groups = from.list<int>();
  block.nodes = from.list<int>();
  block.samples = unpack_samples(from);
  block.undrawn = from.text();
  return block;
}

void pack(Packed& to, const MeshData& data) {
  to.put(data.nodes.data(), data.nodes.size());
  to.put(std::ssize(data.groups));
  for (const PhysicalGroup& group : data.groups) {
    to.put(group.dimension);
    to.put(group.tag);
    to.put(group.name);
  }
  to.put(std::ssize(data.blocks));
  for (const ElementBlock& block : data.blocks) pack(to, block);
}

MeshData unpack_mesh(Unpacked& from) {
  MeshData data;
  data.nodes = from.list<std::array<double, 3>>();
  for (std::int64_t count = from.number(); count > 0; --count) {
    const auto dimension = static_cast<int>(from.number()), tag = static_cast<int>(from.number());
    data.groups.push_back({dimension, tag, from.text()});
  }
  for (std::int64_t count = from.number(); count > 0; --count) data.blocks.push_back(unpack_block(from));
  return data;
}

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

/// Empty if the user has none.
fs::path folder() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "mortise";
  const char* const home = std::getenv("HOME");
  return home && *home ? fs::path(home) / ".cache" / "mortise" : fs::path();
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
    entries.push_back({file.last_write_time(), file.file_size(), file.path()});
    sum += entries.back().size;
  }
  std::ranges::sort(entries, {}, &Entry::used);
  for (auto entry = entries.begin(); sum > largest_cache; ++entry) {
    fs::remove(entry->path);
    sum -= entry->size;
  }
}

}  // namespace

namespace {
bool is_on = false;
}

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
  const std::optional<std::string> bytes = bytes_of(path);
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
    return unpack_mesh(from);
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
  pack(content, data);
  if (content.bytes.size() > largest_cache / 4) return;
  try {
    const fs::path path = entry_of(key), staging = path.string() + "." + std::to_string(::getpid());
    fs::create_directories(folder());
    Packed hash;
    hash.put(static_cast<std::int64_t>(std::hash<std::string>{}(content.bytes)));
    std::ofstream stream(staging, std::ios::binary);
    stream << hash.bytes << content.bytes;
    stream.close();
    if (stream) {
      fs::rename(staging, path);
    } else {
      fs::remove(staging);
    }
    remove_oldest();
  } catch (const fs::filesystem_error&) {  // no room, no right, or another run removes files too
  }
}

}  // namespace mortise
