#include "gmsh/geo_text.hpp"

#include <cctype>
#include <fstream>
#include <sstream>

#include "base/errors.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

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
    } else if (text[i] == '"' || text[i] == '\'') {
      const std::string quote(1, text[i]);
      ++i;
      blank_until(quote);
    }
    ++i;
  }
  return code;
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

GeoText read_geo_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream.is_open() || stream.bad()) throw InputError(file.string() + ": cannot be read");
  return {file, text.str(), code_of(text.str())};
}

std::vector<std::size_t> ends_of_word(const std::string& code, const std::string& word) {
  std::vector<std::size_t> ends;
  for (std::size_t i = code.find(word); i != std::string::npos; i = code.find(word, i + 1)) {
    const std::size_t end = i + word.size();
    if ((i == 0 || !in_word(code[i - 1])) && (end == code.size() || !in_word(code[end]))) ends.push_back(end);
  }
  return ends;
}

std::size_t skip_spaces(const std::string& code, std::size_t i) {
  while (i < code.size() && std::isspace(static_cast<unsigned char>(code[i])) != 0) ++i;
  return i;
}

std::size_t skip_word(const std::string& code, std::size_t i) {
  while (i < code.size() && in_word(code[i])) ++i;
  return i;
}

std::size_t skip_brackets(const std::string& code, std::size_t i) {
  int depth = 0;
  while (i < code.size()) {
    const char c = code[i++];
    if (c == '[' || c == '(' || c == '{') ++depth;
    if (c == ']' || c == ')' || c == '}') --depth;
    if (depth == 0) break;
  }
  return i;
}

std::vector<std::filesystem::path> included_files(const GeoText& geo) {
  std::vector<std::filesystem::path> files;
  for (const char* word : {"Include", "Merge", "MergeFile", "MergeWithBoundingBox", "ShapeFromFile"}) {
    for (const std::size_t end : ends_of_word(geo.code, word)) {
      std::size_t start = skip_spaces(geo.code, end);
      if (start < geo.code.size() && geo.code[start] == '(') start = skip_spaces(geo.code, start + 1);
      const bool quoted = start < geo.code.size() && (geo.code[start] == '"' || geo.code[start] == '\'');
      const std::size_t stop = quoted ? geo.text.find(geo.text[start], start + 1) : std::string::npos;
      const bool named = stop != std::string::npos;
      files.push_back(named ? geo.file.parent_path() / geo.text.substr(start + 1, stop - start - 1) : "");
    }
  }
  return files;
}

}  // namespace mortise
