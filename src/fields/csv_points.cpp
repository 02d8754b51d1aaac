#include "fields/csv_points.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <numeric>
#include <vector>

#include "base/csv_fields.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

class CsvReader {
 public:
  CsvReader(const std::string& file, const std::string& column) : file_(file), stream_(file, std::ios::binary) {
    std::string line;
    if (!next(line)) throw InputError(file + ": cannot be read, or is empty");
    separator_ = csv_separator(line);
    const std::vector<std::string_view> fields = csv_fields(line, separator_);
    const std::vector<std::string> names(fields.begin(), fields.end());
    const bool paraview =
        std::ranges::find(names, "x") == names.end() && std::ranges::find(names, "Points:0") != names.end();
    columns_ = {index(names, paraview ? "Points:0" : "x"), index(names, paraview ? "Points:1" : "y"),
                index(names, column)};
  }

  CsvPoints read() {
    std::string line;
    while (next(line)) {
      if (is_blank_line(line)) continue;
      const std::vector<std::string_view> fields = csv_fields(line, separator_);
      std::array<double, 3> row{};
      for (int k = 0; k < 3; ++k) row[k] = number(fields, columns_[k]);
      rows_.push_back(row);
      lines_.push_back(line_);
    }
    return without_repetition();
  }

 private:
  [[noreturn]] void fail(int line, const std::string& trouble) const {
    throw InputError(file_ + ":" + std::to_string(line) + ": " + printable(trouble));
  }

  bool next(std::string& line) {
    ++line_;
    return bool(std::getline(stream_, line));
  }

  std::size_t index(const std::vector<std::string>& names, const std::string& name) const {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) fail(1, unknown_name("column", name, names));
    return std::size_t(found - names.begin());
  }

  double number(const std::vector<std::string_view>& fields, std::size_t column) const {
    if (column >= fields.size())
      fail(line_, std::to_string(fields.size()) + " fields; expected " + std::to_string(column + 1) + " or more");
    const std::string_view field = fields[column];
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
      fail(line_, "expected a finite number, found '" + std::string(field) + "'");
    return value;
  }

  CsvPoints without_repetition() const {
    std::vector<std::size_t> order(rows_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rows_[i]; });
    std::vector<std::size_t> kept;
    for (const std::size_t i : order) {
      if (kept.empty() || rows_[kept.back()][0] != rows_[i][0] || rows_[kept.back()][1] != rows_[i][1])
        kept.push_back(i);
      else if (rows_[kept.back()][2] != rows_[i][2])
        fail(std::max(lines_[i], lines_[kept.back()]),
             "another value at the place of line " + std::to_string(std::min(lines_[i], lines_[kept.back()])) +
                 "; expected one a place (a .vtu may have one on either side of a line)");
    }
    std::ranges::sort(kept);
    CsvPoints found{Points(kept.size(), 2), VecX(kept.size())};
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const auto& [x, y, value] = rows_[kept[k]];
      found.points.row(Eigen::Index(k)) << x, y;
      found.values[Eigen::Index(k)] = value;
    }
    return found;
  }

  std::string file_;
  std::ifstream stream_;
  char separator_ = ',';
  int line_ = 0;
  std::array<std::size_t, 3> columns_{};  // of x, y and the value
  std::vector<std::array<double, 3>> rows_;
  std::vector<int> lines_;
};

}  // namespace

CsvPoints read_csv_points(const std::string& file, const std::string& column) { return CsvReader(file, column).read(); }

}  // namespace mortise
