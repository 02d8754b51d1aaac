#include "io/geo_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

#include "base/errors.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The text with comments and the insides of strings turned into spaces: every other character keeps its place.
std::string code_of(const std::string& text) {
  std::string code = text;
  std::size_t i = 0;
  const auto blank_until = [&](const std::string& stop) {
    const std::size_t found = text.find(stop, i);
    const std::size_t end = found == std::string::npos ? text.size() : found;
    for (; i < end; ++i) {
      if (code[i] != '\n') code[i] = ' ';
    }
    i = end;
  };
  while (i < text.size()) {
    if (text.compare(i, 2, "//") == 0) {
      blank_until("\n");
    } else if (text.compare(i, 2, "/*") == 0) {
      code[i] = code[i + 1] = ' ';
      i += 2;
      blank_until("*/");
      if (i < text.size()) code[i] = code[i + 1] = ' ';
    } else if (text[i] == '"') {
      ++i;
      blank_until("\"");
    }
    ++i;
  }
  return code;
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t skip_spaces(const std::string& code, std::size_t i) {
  while (i < code.size() && std::isspace(static_cast<unsigned char>(code[i])) != 0) ++i;
  return i;
}

std::size_t skip_word(const std::string& code, std::size_t i) {
  while (i < code.size() && in_word(code[i])) ++i;
  return i;
}

/// Positions just behind each occurrence of the whole word.
std::vector<std::size_t> ends_of_word(const std::string& code, const std::string& word) {
  std::vector<std::size_t> ends;
  for (std::size_t i = code.find(word); i != std::string::npos; i = code.find(word, i + 1)) {
    const std::size_t end = i + word.size();
    if ((i == 0 || !in_word(code[i - 1])) && (end == code.size() || !in_word(code[end]))) ends.push_back(end);
  }
  return ends;
}

/// Whether the entry that goes on at `i` (behind its name) has a string for its default.
bool is_string(const std::string& code, std::size_t i) {
  i = skip_spaces(code, i);
  if (i >= code.size() || code[i] != '=') return false;
  i = skip_spaces(code, i + 1);
  if (i < code.size() && code[i] == '{') i = skip_spaces(code, i + 1);
  return i < code.size() && (code[i] == '"' || code.compare(i, 3, "Str") == 0);
}

/// Names of the list "[ a = 1, b = {2, Min 1}, c ]" that starts at `i`.
void add_constants(const std::string& code, std::size_t i, std::vector<std::string>& names) {
  i = skip_spaces(code, i);
  if (i >= code.size() || (code[i] != '[' && code[i] != '(')) return;
  int depth = 0;
  do {
    const char c = code[i++];
    if (c == '[' || c == '(' || c == '{') ++depth;
    if (c == ']' || c == ')' || c == '}') --depth;
    if (depth != 1 || (c != '[' && c != '(' && c != ',')) continue;
    const std::size_t start = skip_spaces(code, i);
    const std::size_t end = skip_word(code, start);
    if (end > start && !is_string(code, end)) names.push_back(code.substr(start, end - start));
    i = end;
  } while (depth > 0 && i < code.size());
}

void check_no_exit(const fs::path& file, const std::string& code) {
  for (const std::size_t end : ends_of_word(code, "Exit")) {
    const auto line = 1 + std::count(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw InputError(file.string() + ", line " + std::to_string(line) +
                     ": the command Exit would end the program; remove it");
  }
}

/// The files that this one reads with Include or Merge "name".
std::vector<fs::path> included_files(const fs::path& file, const std::string& text, const std::string& code) {
  std::vector<fs::path> files;
  for (const char* word : {"Include", "Merge"}) {
    for (const std::size_t end : ends_of_word(code, word)) {
      const std::size_t start = skip_spaces(code, end);
      if (start >= code.size() || code[start] != '"') continue;
      const std::size_t stop = text.find('"', start + 1);
      if (stop == std::string::npos) continue;
      const fs::path name = text.substr(start + 1, stop - start - 1);
      if (name.extension() == ".msh") continue;
      files.push_back(file.parent_path() / name);
    }
  }
  return files;
}

void scan(const fs::path& file, std::set<fs::path>& seen, std::vector<std::string>& names) {
  if (!fs::is_regular_file(file) || !seen.insert(fs::weakly_canonical(file)).second) return;
  const std::string text = read_text(file);
  const std::string code = code_of(text);
  check_no_exit(file, code);
  for (const std::size_t end : ends_of_word(code, "DefineConstant")) add_constants(code, end, names);
  for (const fs::path& included : included_files(file, text, code)) scan(included, seen, names);
}

}  // namespace

std::vector<std::string> geo_parameters(const fs::path& file) {
  std::set<fs::path> seen;
  std::vector<std::string> names;
  scan(file, seen, names);
  std::set<std::string> listed;
  std::erase_if(names, [&listed](const std::string& name) { return !listed.insert(name).second; });
  return names;
}

}  // namespace mortise
