#include "mesh_files/packed_mesh.hpp"

#include <algorithm>
#include <stdexcept>

#include "mesh_files/element_types.hpp"

namespace mortise {
namespace {

// An edge: how many pieces it has, its misfit; a piece: its end, its places.
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
  constexpr std::size_t a_piece = 1 + 2 * std::tuple_size_v<decltype(SamplePiece::places)>;
  for (auto x = numbers.begin(); x != numbers.end();) {
    const double count = *x++;
    if (x == numbers.end() || !(count >= 0 && count * double(a_piece) < double(numbers.end() - x)))
      throw std::out_of_range("packed samples");
    EdgeSamples& edge = edges.emplace_back();
    edge.pieces.resize(std::size_t(count));
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

/// Throws std::out_of_range unless the nodes are there and the kinds of elements known.
void check(const MeshData& data) {
  for (const ElementBlock& block : data.blocks) {
    const ElementType* const type = element_type(block.type);
    const auto known = [&](int node) { return node >= 0 && node < std::ssize(data.nodes); };
    if (!type || type->dimension() != block.dimension || block.nodes.size() % std::size_t(type->node_count) != 0 ||
        !std::ranges::all_of(block.nodes, known) ||
        (!block.samples.empty() && block.samples.size() != block.nodes.size() / std::size_t(type->node_count)))
      throw std::out_of_range("packed mesh");
  }
}

}  // namespace

void put_groups(Packed& to, const std::vector<PhysicalGroup>& groups) {
  to.put(std::ssize(groups));
  for (const PhysicalGroup& group : groups) {
    to.put(group.dimension);
    to.put(group.tag);
    to.put(group.name);
  }
}

std::vector<PhysicalGroup> take_groups(Unpacked& from) {
  std::vector<PhysicalGroup> groups;
  for (std::int64_t count = from.number(); count > 0; --count) {
    const auto dimension = static_cast<int>(from.number()), tag = static_cast<int>(from.number());
    groups.push_back({dimension, tag, from.text()});
  }
  return groups;
}

std::string packed_mesh(const MeshData& data) {
  Packed to;
  to.put(data.nodes.data(), data.nodes.size());
  put_groups(to, data.groups);
  to.put(std::ssize(data.blocks));
  for (const ElementBlock& block : data.blocks) pack(to, block);
  return std::move(to.bytes);
}

MeshData unpacked_mesh(std::string_view bytes) {
  Unpacked from(bytes);
  MeshData data;
  data.nodes = from.list<std::array<double, 3>>();
  data.groups = take_groups(from);
  for (std::int64_t count = from.number(); count > 0; --count) data.blocks.push_back(unpack_block(from));
  check(data);
  return data;
}

}  // namespace mortise
