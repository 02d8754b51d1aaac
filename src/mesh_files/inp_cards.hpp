// The text of an Abaqus or CalculiX deck: cards with parameters, and their lines of data.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_files/deck.hpp"

namespace mortise {

struct InpCard {
  std::string name;                               ///< "SOLIDSECTION": upper case, no blanks
  std::map<std::string, std::string> parameters;  ///< by name in upper case, no blanks; values as written
  std::size_t place;                              ///< for MshInput::fail_at
  std::vector<DeckRecord> lines;
};

/// All cards of the file, without comments. Throws InputError: text before the first card.
std::vector<InpCard> read_inp_cards(MshInput& input);

/// The value of a parameter, if it is there.
std::optional<std::string> parameter(const InpCard& card, const std::string& name);

/// In upper case, without blanks.
std::string inp_key(std::string_view text);

/// Throws InputError with the card's line and name.
[[noreturn]] void fail(const MshInput& input, const InpCard& card, const std::string& trouble);

}  // namespace mortise
