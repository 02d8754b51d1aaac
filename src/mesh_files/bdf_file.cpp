#include "mesh_files/bdf_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "mesh_files/element_types.hpp"

namespace mortise {
namespace {

struct Entry {
  std::string name;
  int line;
  std::vector<std::string> fields;  // after the name, without blanks
};

/// gmsh's number of the kind of element, by the entry's name.
const std::map<std::string, int> kinds{{"CTRIA3", 2},  {"CTRIAR", 2},  {"CPLSTN3", 2},  {"CPLSTS3", 2},  {"CTRIA6", 9},
                                       {"CPLSTN6", 9}, {"CPLSTS6", 9}, {"CQUAD4", 3},   {"CQUADR", 3},   {"CPLSTN4", 3},
                                       {"CPLSTS4", 3}, {"CQUAD8", 16}, {"CPLSTN8", 16}, {"CPLSTS8", 16}, {"CBAR", 1},
                                       {"CBEAM", 1},   {"CROD", 1}};

bool is_solid(const std::string& name) {
  for (const char* other : {"CHEXA", "CTETRA", "CPENTA", "CPYRAM", "CTRIAX", "CQUADX", "CQUAD", "CSHEAR"})
    if (name.starts_with(other)) return true;
  return false;
}

bool is_left_out(const std::string& name) {
  for (const char* other :
       {"CELAS", "CBUSH", "CDAMP", "CMASS", "CONM", "CGAP", "CVISC", "CONROD", "CFAST", "RBE", "RBAR"})
    if (name.starts_with(other)) return true;
  return false;
}

std::string without_blanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The first one is the name, or the mark of a line that goes on; the mark at the end is left out.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  if (line.find(',') != std::string::npos) {
    for (std::size_t from = 0; from <= line.size();) {
      const std::size_t end = std::min(line.find(',', from), line.size());
      fields.push_back(without_blanks(line.substr(from, end - from)));
      from = end + 1;
    }
    if (fields.size() > 9) fields.resize(9);
    return fields;
  }
  const std::string head = line.substr(0, 8);
  const bool wide = head.find('*') != std::string::npos;
  fields.push_back(without_blanks(head));
  const std::size_t width = wide ? 16 : 8;
  for (std::size_t from = 8; from < std::min<std::size_t>(line.size(), 72); from += width)
    fields.push_back(without_blanks(line.substr(from, width)));
  return fields;
}

/// Tabs go to the next multiple of eight.
std::string without_tabs(const std::string& line) {
  std::string text;
  for (const char c : line) {
    if (c != '\t')
      text += c;
    else
      text.append(8 - text.size() % 8, ' ');
  }
  return text;
}

class BdfReader {
 public:
  explicit BdfReader(const std::string& file) { mesh_.file = file; }

  SetMesh read() {
    std::vector<Entry> nodes, elements;
    for (Entry& entry : entries()) {
      if (entry.name == "INCLUDE") fail(entry, "included files are not read; expected their text here");
      if (entry.name == "GRID")
        nodes.push_back(std::move(entry));
      else if (kinds.contains(entry.name))
        elements.push_back(std::move(entry));
      else if (is_solid(entry.name))
        fail(entry, entry.name + " is not supported; expected CTRIA3, CQUAD4, CTRIA6, CQUAD8, CPLSTN or CPLSTS");
      else if (is_left_out(entry.name))
        ++left_out_[entry.name];
    }
    std::vector<std::int64_t> tags;
    for (const Entry& entry : nodes) tags.push_back(read_node(entry));
    require_once(tags, nodes, "node");
    const NodeRows rows(tags);
    tags.clear();
    std::vector<int> properties;
    for (const Entry& entry : elements) {
      tags.push_back(integer(entry, 0, "an element's number"));
      const bool has_property = entry.fields.size() > 1 && !entry.fields[1].empty();
      properties.push_back(has_property ? int(integer(entry, 1, "a property's number")) : -1);
      read_element(entry, tags.back(), rows);
    }
    require_once(tags, elements, "element");
    for (const auto& [name, count] : left_out_)
      mesh_.notes.push_back("left out: " + std::to_string(count) + " entries " + name);
    add_property_sets(properties, mesh_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const Entry& entry, const std::string& trouble) const {
    throw InputError(printable(mesh_.file + ", line " + std::to_string(entry.line) + ": " + trouble));
  }

  /// Those before BEGIN BULK are no bulk data, and are known here by nothing.
  std::vector<Entry> entries() const {
    std::vector<Entry> found;
    std::ifstream stream(mesh_.file, std::ios::binary);
    if (!stream) throw InputError(mesh_.file + ": cannot be read");
    std::string text;
    for (int line = 1; std::getline(stream, text); ++line) {
      text = without_tabs(text.substr(0, text.find_first_of("$\r")));
      if (without_blanks(text).empty()) continue;
      std::vector<std::string> fields = fields_of(text);
      std::string name = fields[0];
      if (name.empty() || name[0] == '+' || name[0] == '*') {
        if (!found.empty()) {
          found.back().fields.resize((found.back().fields.size() + 3) / 4 * 4);
          found.back().fields.insert(found.back().fields.end(), fields.begin() + 1, fields.end());
        }
        continue;
      }
      if (name.back() == '*') name.pop_back();
      std::ranges::transform(name, name.begin(),
                             [](char c) { return char(std::toupper(static_cast<unsigned char>(c))); });
      if (name == "ENDDATA") break;
      found.push_back({without_blanks(name.substr(0, name.find(' '))), line, {fields.begin() + 1, fields.end()}});
    }
    return found;
  }

  std::int64_t integer(const Entry& entry, std::size_t field, const char* what) const {
    const std::string text = field < entry.fields.size() ? entry.fields[field] : "";
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value <= 0 || value > 2'000'000'000)
      fail(entry, entry.name + ": expected " + what + ", a number > 0, found '" + text + "'");
    return value;
  }

  /// Empty is 0; the e of an exponent may be left out: 1.5-3.
  double real(const Entry& entry, std::size_t field) const {
    std::string text = field < entry.fields.size() ? entry.fields[field] : "";
    if (text.empty()) return 0;
    const std::string as_written = text;
    std::ranges::replace_if(
        text, [](char c) { return c == 'd' || c == 'D' || c == 'E'; }, 'e');
    if (text[0] == '+') text.erase(0, 1);
    const std::size_t sign = text.find_first_of("+-", 1);
    if (sign != std::string::npos && text[sign - 1] != 'e') text.insert(sign, "e");
    if (const std::size_t plus = text.find("e+"); plus != std::string::npos) text.erase(plus + 1, 1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(entry, entry.name + ": expected a coordinate, found '" + as_written + "'");
    return value;
  }

  std::int64_t read_node(const Entry& entry) {
    if (entry.fields.size() > 1 && !entry.fields[1].empty() && entry.fields[1] != "0")
      fail(entry, "GRID: the coordinate system " + entry.fields[1] + " is not supported; expected none, or 0");
    mesh_.nodes.push_back({real(entry, 2), real(entry, 3), real(entry, 4)});
    return integer(entry, 0, "a node's number");
  }

  void read_element(const Entry& entry, std::int64_t tag, const NodeRows& rows) {
    SetElement element{tag, kinds.at(entry.name), {}};
    const int count = element_type(element.type)->node_count;
    for (std::size_t k = 0; k < std::size_t(count); ++k) {
      const int row = rows.find(integer(entry, 2 + k, "a node's number"));
      if (row < 0) fail(entry, entry.name + ": there is no node " + entry.fields[2 + k]);
      element.nodes.push_back(row);
    }
    mesh_.elements.push_back(std::move(element));
  }

  void require_once(const std::vector<std::int64_t>& tags, const std::vector<Entry>& from, const char* what) const {
    if (const std::int64_t repeated = first_repeated(tags); repeated >= 0)
      fail(from[repeated], std::string("the ") + what + " " + std::to_string(tags[repeated]) + " is listed twice");
  }

  SetMesh mesh_;
  std::map<std::string, int> left_out_;
};

}  // namespace

SetMesh read_bdf(const std::string& file) { return BdfReader(file).read(); }

}  // namespace mortise
