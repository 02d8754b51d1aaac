#include "mesh_files/inp_cards.hpp"

#include <algorithm>
#include <cctype>

#include "base/csv_fields.hpp"

namespace mortise {
namespace {

/// Between the commas; nothing behind the last one.
std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> fields = fields_between_commas(text);
  if (fields.back().empty()) fields.pop_back();
  return fields;
}

bool ends_in_comma(std::string_view text) {
  const std::size_t last = text.find_last_not_of(" \t\r");
  return last != text.npos && text[last] == ',';
}

void add_parameters(InpCard& card, const std::vector<std::string>& fields, std::size_t first) {
  for (std::size_t i = first; i < fields.size(); ++i) {
    const std::size_t equals = std::min(fields[i].find('='), fields[i].size());
    const std::string value =
        equals < fields[i].size() ? bare_field(std::string_view(fields[i]).substr(equals + 1)) : "";
    card.parameters[inp_key(std::string_view(fields[i]).substr(0, equals))] = value;
  }
}

}  // namespace

std::string inp_key(std::string_view text) {
  std::string key;
  for (const char c : text)
    if (c != ' ' && c != '\t' && c != '\r') key += char(std::toupper(static_cast<unsigned char>(c)));
  return key;
}

std::vector<InpCard> read_inp_cards(MshInput& input) {
  std::vector<InpCard> cards;
  std::string_view line;
  bool card_goes_on = false;
  while (input.next_line(line)) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty() || line.starts_with("**")) continue;
    const std::vector<std::string> fields = split(line);
    if (line.starts_with('*')) {
      cards.push_back({inp_key(std::string_view(fields.at(0)).substr(1)), {}, input.record(), {}});
      add_parameters(cards.back(), fields, 1);
    } else if (cards.empty()) {
      input.fail("this is no deck of Abaqus or CalculiX: expected a card such as *NODE, found '" +
                 std::string(line.substr(0, 40)) + "'");
    } else if (card_goes_on) {
      add_parameters(cards.back(), fields, 0);
    } else if (!fields.empty()) {
      cards.back().lines.push_back({.place = input.record(), .fields = fields, .goes_on = ends_in_comma(line)});
    }
    card_goes_on = (line.starts_with('*') || card_goes_on) && ends_in_comma(line);
  }
  return cards;
}

std::optional<std::string> parameter(const InpCard& card, const std::string& name) {
  const auto found = card.parameters.find(name);
  return found == card.parameters.end() ? std::nullopt : std::optional(found->second);
}

void fail(const MshInput& input, const InpCard& card, const std::string& trouble) {
  input.fail_at(card.place, "*" + card.name + ": " + trouble);
}

}  // namespace mortise
