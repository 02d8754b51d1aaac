#include "output/csv.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "base/errors.hpp"

namespace mortise {
namespace {

bool is_number(const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

void append_number(std::string& text, double number) {
  if (std::isnan(number)) return;
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::general, 17);
  text.append(digits.data(), end.ptr);
}

std::size_t row_count(const CsvColumn& column) { return std::max(column.words.size(), column.numbers.size()); }

std::string table_text(const std::vector<CsvColumn>& columns) {
  std::string text;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (j > 0) text += ',';
    text += csv_field(columns[j].name);
  }
  text += '\n';
  const std::size_t rows = columns.empty() ? 0 : row_count(columns.front());
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if (j > 0) text += ',';
      const CsvColumn& column = columns[j];
      if (column.words.empty()) {
        append_number(text, column.numbers[i]);
      } else {
        text += csv_field(column.words[i]);
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace

// Quoted where a plain field would be read as something else (RFC 4180; the semicolon parts fields in some countries).
// A spreadsheet takes what starts with = + - @ for a formula: an apostrophe before it says that it is text (OWASP,
// "CSV injection").
std::string csv_field(const std::string& word) {
  const bool formula = !word.empty() && std::string_view("=+-@\t\r").find(word[0]) != std::string_view::npos;
  const std::string field = formula && !is_number(word) ? "'" + word : word;
  if (field.find_first_of(",;\"\t\r\n") == std::string::npos && field == word) return word;
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void write_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& columns) {
  for ([[maybe_unused]] const CsvColumn& column : columns) {
    assert(row_count(column) == row_count(columns.front()) && "columns of one length");
    assert((column.words.empty() || column.numbers.empty()) && "words or numbers, not both");
  }
  const std::string text = table_text(columns);
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) throw InputError(path.string() + ": cannot be written");
}

}  // namespace mortise
