#include "scene/fail.hpp"

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise::scene_file {
namespace {

constexpr std::size_t longest_value = 80;
constexpr std::size_t longest_setting = 400;

std::string clipped(const std::string& text, std::size_t longest = longest_value) {
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

/// Appended piece by piece: gcc 12 warns falsely (-Wrestrict) of "[" + std::string.
std::string quoted(char before, const std::string& text, char after) {
  std::string all(1, before);
  all += text;
  all += after;
  return all;
}

std::string describe_list(const Node& list) {
  std::string text;
  for (const Node& item : list.items) {
    if (!text.empty()) text += ", ";
    text += describe(item);
  }
  return quoted('[', clipped(text), ']');
}

}  // namespace

void fail(const Place& place, const std::string& path, const std::string& trouble) {
  std::string text = place.file;
  if (!place.setting.empty()) {
    text += ": " + clipped(place.setting, longest_setting);
  } else if (place.line > 0) {
    text += ':';
    text += std::to_string(place.line);
    if (place.column > 0) text += ":" + std::to_string(place.column);
  }
  if (!path.empty()) text += ": " + clipped(path, longest_setting);
  throw InputError(printable(text + ": " + trouble));
}

void fail(const Node& node, const std::string& trouble) { fail(node.place, node.path, trouble); }

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::table:
      return "a table";
    case Node::Kind::list:
      return describe_list(node);
    case Node::Kind::string:
      return quoted('\'', clipped(node.text), '\'');
    case Node::Kind::date:
      return "the date or time " + node.text;
    case Node::Kind::number:
    case Node::Kind::boolean:
      break;
  }
  return node.text;
}

std::string locate(const Node& node) {
  const Place& place = node.place;
  return node.path + " (" + (place.setting.empty() ? "line " + std::to_string(place.line) : place.setting) + ")";
}

const Node& blame(const Node& first, const Node& second) {
  return !first.place.setting.empty() && second.place.setting.empty() ? first : second;
}

void Once::take(const std::string& what, const Node& node, const Node& entry) {
  const auto [first, is_new] = takers_.try_emplace(what, Taker{&node, &entry});
  if (is_new) return;
  const bool blames_first = &blame(*first->second.node, node) == first->second.node;
  const Node& guilty = blames_first ? *first->second.node : node;
  const Node& other = blames_first ? entry : *first->second.entry;
  const std::string where = &entry == first->second.entry ? "" : ", in " + locate(other) + " too";
  fail(guilty, what + " twice" + where + "; expected once");
}

}  // namespace mortise::scene_file
