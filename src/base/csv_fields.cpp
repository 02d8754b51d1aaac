#include "base/csv_fields.hpp"

namespace mortise {
namespace {

// Without blanks around it, and the quotes round those.
std::string_view bare(std::string_view field) {
  for (const std::string_view around : {" \t\r", "\"", " \t"}) {
    const std::size_t first = field.find_first_not_of(around);
    if (first == std::string_view::npos) return {};
    field = field.substr(first, field.find_last_not_of(around) - first + 1);
  }
  return field;
}

}  // namespace

char csv_separator(std::string& header) {
  if (header.starts_with("\xef\xbb\xbf")) header.erase(0, 3);
  char separator = ',';
  for (const char c : {'\t', ';', ','})
    if (header.find(c) != std::string::npos) separator = c;
  return separator;
}

std::vector<std::string_view> csv_fields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  bool quoted = false;
  std::size_t from = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != separator)) continue;
    fields.push_back(bare(line.substr(from, i - from)));
    from = i + 1;
  }
  return fields;
}

std::string bare_field(std::string_view field) { return std::string(bare(field)); }

bool is_blank_line(std::string_view line) { return bare(line).empty(); }

}  // namespace mortise
