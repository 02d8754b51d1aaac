// Lines of tables that a user or another program wrote.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mortise {

/// What parts the fields of a table with this header, from which a byte order mark is taken: a comma where there is
/// one, else a semicolon or a tab.
char csv_separator(std::string& header);

/// The fields of a line, without blanks and the quotes around them; nothing between quotes parts two fields.
std::vector<std::string_view> csv_fields(std::string_view line, char separator);

/// Without the blanks around it, and the quotes round what is left.
std::string bare_field(std::string_view field);

bool is_blank_line(std::string_view line);

}  // namespace mortise
