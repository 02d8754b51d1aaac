// The text of an Abaqus or CalculiX deck: cards with parameters, and their lines of data.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_files/msh_input.hpp"

namespace mortise {

struct InpLine {
  std::size_t record;               ///< for MshInput::fail_at
  std::vector<std::string> fields;  ///< between the commas, without blanks around them
  bool goes_on;                     ///< ends in a comma
};

struct InpCard {
  std::string name;                               ///< "SOLIDSECTION": upper case, no blanks
  std::map<std::string, std::string> parameters;  ///< by name in upper case, no blanks; values as written
  std::size_t record;
  std::vector<InpLine> lines;
};

/// All cards of the file, without comments. Throws InputError: text before the first card.
std::vector<InpCard> read_inp_cards(MshInput& input);

/// The value of a parameter, if it is there.
std::optional<std::string> parameter(const InpCard& card, const std::string& name);

/// In upper case, without blanks.
std::string inp_key(std::string_view text);

/// Throw InputError with file and line.
std::int64_t inp_integer(const MshInput& input, const InpLine& line, const std::string& field, const char* what);
double inp_real(const MshInput& input, const InpLine& line, const std::string& field, const char* what);

}  // namespace mortise
