#include "mesh_files/deck.hpp"

#include <charconv>
#include <cmath>

#include "base/csv_fields.hpp"

namespace mortise {
namespace {

/// Whether the text, which a + may begin, is a number.
template <typename T>
bool parse(std::string_view text, T& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::vector<std::string> fields_between_commas(std::string_view line) {
  const std::vector<std::string_view> fields = csv_fields(line, ',');
  return {fields.begin(), fields.end()};
}

Deck::Deck(const std::string& file) : input(file) { mesh.file = file; }

void Deck::fail(const DeckRecord& record, const std::string& trouble) const {
  input.fail_at(record.place, (record.name.empty() ? "" : record.name + ": ") + trouble);
}

std::int64_t Deck::integer(const DeckRecord& record, const std::string& field, const char* what) const {
  std::int64_t value = 0;
  if (!parse(field, value) || value <= 0)
    fail(record, std::string("expected ") + what + ", a number > 0, found '" + field + "'");
  return value;
}

double Deck::real(const DeckRecord& record, const std::string& field, const char* what) const {
  std::string text = field;
  for (char& c : text)
    if (c == 'd' || c == 'D' || c == 'E') c = 'e';
  const std::size_t sign = text.find_first_of("+-", 1);
  if (short_exponents && sign != std::string::npos && text[sign - 1] != 'e') text.insert(sign, "e");
  double value = 0;
  if (!parse(text, value) || !std::isfinite(value))
    fail(record, std::string("expected ") + what + ", found '" + field + "'");
  return value;
}

std::array<double, 3>& Deck::add_node(const DeckRecord& record) {
  node_tags_.add_at(input, record.place, integer(record, record.field(0), "a node's number"));
  return mesh.nodes.emplace_back();
}

void Deck::number_nodes() {
  node_tags_.require_once(input);
  nodes = TagRows(node_tags_.all());
}

SetElement& Deck::add_element(const DeckRecord& record, int type) {
  const std::int64_t tag = integer(record, record.field(0), "an element's number");
  element_tags_.add_at(input, record.place, tag);
  return mesh.elements.emplace_back(SetElement{tag, type, {}});
}

void Deck::number_elements() {
  element_tags_.require_once(input);
  elements = TagRows(element_tags_.all());
}

int Deck::node(const DeckRecord& record, const std::string& field) const {
  const std::int64_t tag = integer(record, field, "a node's number");
  const int row = nodes.find(tag);
  if (row < 0) fail(record, "there is no node " + std::to_string(tag));
  return row;
}

void Deck::leave_out(int count, const std::string& kind, const std::string& kinds, const std::string& name) {
  mesh.notes.push_back("left out: " + std::to_string(count) + " " + (count == 1 ? kind : kinds) + " " + name);
}

}  // namespace mortise
