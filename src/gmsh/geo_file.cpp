#include "gmsh/geo_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>

#include "base/errors.hpp"
#include "gmsh/geo_text.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

/// The plain number at `i`, if there is one and nothing but a separator follows it.
std::optional<double> number_at(const std::string& code, std::size_t i) {
  i = skip_spaces(code, i);
  double value = 0;
  const auto [end, error] = std::from_chars(code.data() + i, code.data() + code.size(), value);
  if (error != std::errc()) return std::nullopt;
  const std::size_t next = skip_spaces(code, static_cast<std::size_t>(end - code.data()));
  const bool whole = next >= code.size() || std::string_view(",}=").find(code[next]) != std::string_view::npos;
  return whole ? std::optional(value) : std::nullopt;
}

std::optional<double> number_behind(const std::string& entry, const char* word) {
  const std::vector<std::size_t> ends = ends_of_word(entry, word);
  return ends.empty() ? std::nullopt : number_at(entry, ends.front());
}

/// The numbers of Choices{1, 2} or Choices{0="no", 1="yes"}; none if one of them is not plain.
std::vector<double> choices_of(const std::string& entry) {
  std::vector<double> choices;
  for (const std::size_t end : ends_of_word(entry, "Choices")) {
    const std::size_t open = skip_spaces(entry, end);
    if (open >= entry.size() || entry[open] != '{') return {};
    const std::size_t stop = skip_brackets(entry, open);
    for (std::size_t i = open; i < stop && entry[i] != '}'; i = std::min(entry.find_first_of(",}", i + 1), stop)) {
      const std::optional<double> choice = number_at(entry, i + 1);
      if (!choice) return {};
      choices.push_back(*choice);
    }
  }
  return choices;
}

/// Whether the entry that goes on at `i` (behind its name) has a string for its default.
bool is_string(const std::string& code, std::size_t i) {
  i = skip_spaces(code, i);
  if (i >= code.size() || code[i] != '=') return false;
  i = skip_spaces(code, i + 1);
  if (i < code.size() && code[i] == '{') i = skip_spaces(code, i + 1);
  return i < code.size() && (code[i] == '"' || code[i] == '\'' || code.compare(i, 3, "Str") == 0);
}

/// The list "[ a = 1, b = {2, Min 1}, c ]" that starts at `i`.
void add_constants(const std::string& code, std::size_t i, std::vector<GeoParameter>& parameters) {
  i = skip_spaces(code, i);
  if (i >= code.size() || (code[i] != '[' && code[i] != '(')) return;
  const std::size_t stop = skip_brackets(code, i);
  while (++i < stop) {
    const std::size_t start = skip_spaces(code, i);
    const std::size_t end = skip_word(code, start);
    for (i = end; i < stop && code[i] != ',' && code[i] != ']' && code[i] != ')';) {
      i = code[i] == '{' || code[i] == '(' || code[i] == '[' ? skip_brackets(code, i) : i + 1;
    }
    if (end == start || is_string(code, end)) continue;
    const std::string entry = code.substr(end, std::min(i, stop) - end);
    parameters.push_back(
        {code.substr(start, end - start), number_behind(entry, "Min"), number_behind(entry, "Max"), choices_of(entry)});
  }
}

bool is_text(const fs::path& file) {
  std::error_code ignored;
  return file.extension() != ".msh" && fs::is_regular_file(file, ignored);
}

/// Calls visit(GeoText) for `file` and the files it includes, each once.
template <typename Visit>
void for_each_text(const fs::path& file, std::set<fs::path>& seen, Visit visit) {
  std::error_code ignored;
  if (!is_text(file) || !seen.insert(fs::weakly_canonical(file, ignored)).second) return;
  const GeoText geo = read_geo_text(file);
  visit(geo);
  for (const fs::path& include : included_files(geo)) for_each_text(include, seen, visit);
}

std::string decimal(double value) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%.10g", value);
  return digits.data();
}

void check_range(const fs::path& file, const GeoParameter& parameter, double value) {
  std::string expected;
  if (parameter.min && value < *parameter.min) expected = "at least " + decimal(*parameter.min);
  if (parameter.max && value > *parameter.max) expected = "at most " + decimal(*parameter.max);
  if (!parameter.choices.empty() &&
      std::find(parameter.choices.begin(), parameter.choices.end(), value) == parameter.choices.end()) {
    for (const double choice : parameter.choices) expected += (expected.empty() ? "" : " or ") + decimal(choice);
  }
  if (expected.empty()) return;
  throw InputError(file.string() + ": parameter '" + parameter.name + "' = " + decimal(value) + ": expected " +
                   expected + ", as its DefineConstant says");
}

}  // namespace

std::vector<GeoParameter> geo_parameters(const fs::path& file) {
  std::set<fs::path> seen;
  std::vector<GeoParameter> parameters;
  for_each_text(file, seen, [&](const GeoText& geo) {
    for (const std::size_t end : ends_of_word(geo.code, "DefineConstant")) add_constants(geo.code, end, parameters);
  });
  std::set<std::string> listed;
  std::erase_if(parameters, [&](const GeoParameter& parameter) { return !listed.insert(parameter.name).second; });
  return parameters;
}

std::vector<fs::path> geo_inputs(const fs::path& file) {
  std::set<fs::path> seen;
  std::vector<fs::path> files{file};
  for_each_text(file, seen, [&](const GeoText& geo) {
    for (const fs::path& include : included_files(geo)) {
      if (!include.empty()) files.push_back(include);
    }
  });
  return files;
}

std::optional<std::vector<fs::path>> geo_sources(const fs::path& file) {
  constexpr std::array outward{
      "GetEnv",       "GetValue",   "GetStringValue", "GetNumber",       "GetString", "Today",      "Rand",
      "Cpu",          "Memory",     "TotalMemory",    "CurrentFileName", "DirName",   "CurrentDir", "CurrentDirectory",
      "AbsolutePath", "FileExists", "FileName",       "ListFromFile",    "Plugin"};
  bool closed = true;
  std::set<fs::path> seen;
  try {
    for_each_text(file, seen, [&](const GeoText& geo) {
      for (const char* word : outward) closed = closed && ends_of_word(geo.code, word).empty();
      for (const fs::path& include : included_files(geo)) closed = closed && !include.empty();
    });
  } catch (const InputError&) {  // a file that is not there
    return std::nullopt;
  }
  return closed ? std::optional(geo_inputs(file)) : std::nullopt;
}

void check_geo(const fs::path& file, const std::map<std::string, double>& values) {
  const std::vector<GeoParameter> known = geo_parameters(file);
  std::vector<std::string> names;
  for (const GeoParameter& parameter : known) names.push_back(parameter.name);
  for (const auto& [name, value] : values) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw InputError(file.string() + ": " + unknown_name("parameter (DefineConstant)", name, names));
    }
    if (!std::isfinite(value)) {
      throw InputError(file.string() + ": parameter '" + name + "' is not a finite number");
    }
    check_range(file, known[found - names.begin()], value);
  }
}

}  // namespace mortise
