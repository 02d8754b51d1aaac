// Comma-separated tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mortise {

/// A column of words or of numbers (17 significant digits; NaN is an empty field).
struct CsvColumn {
  std::string name;
  std::vector<std::string> words;
  std::vector<double> numbers;
};

/// A word as it stands in a table.
std::string csv_field(const std::string& word);

/// All columns have the same length. A word that a spreadsheet would take for a formula gets an apostrophe before it.
/// Throws InputError if the file cannot be written.
void write_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& columns);

}  // namespace mortise
