#include "base/printable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace mortise {
namespace {

using Byte = unsigned char;

// A character of UTF-8 text: its number, and how many bytes it takes; no bytes if they are no UTF-8.
struct Character {
  std::uint32_t code;
  std::size_t bytes;
};

Character character_at(const std::string& text, std::size_t i) {
  const Byte first = Byte(text[i]);
  const std::size_t bytes = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (bytes == 0 || i + bytes > text.size()) return {0, 0};
  std::uint32_t code = bytes == 1 ? first : first & (0x7fu >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    const Byte next = Byte(text[i + k]);
    if (next >> 6 != 2) return {0, 0};
    code = code << 6 | (next & 0x3f);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < least[bytes] || code > 0x10ffff || surrogate ? Character{0, 0} : Character{code, bytes};
}

// Controls, and what turns the direction of a line round or cannot be seen: categories Cc, Cf, Zl, Zp (Unicode 15), and
// all that is private or unassigned at the end.
bool is_unseen(std::uint32_t c) {
  constexpr std::array<std::array<std::uint32_t, 2>, 19> ranges{{
      {0x0, 0x1f},        {0x7f, 0x9f},       {0xad, 0xad},       {0x600, 0x605},     {0x61c, 0x61c},
      {0x6dd, 0x6dd},     {0x70f, 0x70f},     {0x890, 0x891},     {0x8e2, 0x8e2},     {0x180e, 0x180e},
      {0x200b, 0x200f},   {0x2028, 0x202e},   {0x2060, 0x206f},   {0xfeff, 0xfeff},   {0xfff9, 0xfffb},
      {0x110bd, 0x110cd}, {0x13430, 0x1343f}, {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a},
  }};
  return c >= 0xe0000 ||
         std::any_of(ranges.begin(), ranges.end(), [&](const auto& r) { return r[0] <= c && c <= r[1]; });
}

std::string escaped(std::uint32_t c) {
  if (c == '\n') return "\\n";
  if (c == '\r') return "\\r";
  if (c == '\t') return "\\t";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), c < 0x100 ? "\\x%02x" : "\\u%04x", c);
  return text.data();
}

}  // namespace

std::string printable(const std::string& text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    const Character c = character_at(text, i);
    if (c.bytes == 0)
      shown += escaped(Byte(text[i]));
    else if (is_unseen(c.code))
      shown += escaped(c.code);
    else
      shown += text.substr(i, c.bytes);
    i += std::max<std::size_t>(c.bytes, 1);
  }
  return shown;
}

std::string in_short(const std::string& line) {
  constexpr std::size_t start = 700, end = 200;
  if (line.size() <= start + end) return line;
  std::size_t from = line.size() - end, to = start;
  while (from < line.size() && Byte(line[from]) >> 6 == 2) ++from;  // not within a character
  while (Byte(line[to]) >> 6 == 2) --to;
  return line.substr(0, to) + " [...] " + line.substr(from);
}

std::string listed(const std::vector<std::string>& names) {
  const std::size_t told = names.size() > told_in_full ? told_of_many : names.size();
  std::string text;
  for (std::size_t i = 0; i < told; ++i) text += (i > 0 ? ", " : "") + names[i];
  if (told < names.size()) text += " and " + std::to_string(names.size() - told) + " more";
  return text;
}

void append_lines(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

std::string percent(double part) {
  if (part > 10) return "more than 1000 %";
  std::array<char, 40> text{};
  if (part >= 0.995)  // which two digits would make 1e+02
    std::snprintf(text.data(), text.size(), "%.0f %%", 10 * std::round(10 * part));
  else
    std::snprintf(text.data(), text.size(), "%.2g %%", 100 * part);
  return text.data();
}

std::string two_digits(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

std::string shortest(double number) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

std::string near_point(const Vec2& point) {
  std::array<char, 80> text{};
  // Adding zero turns -0 into 0.
  std::snprintf(text.data(), text.size(), "near (%.6g, %.6g)", point.x() + 0.0, point.y() + 0.0);
  return text.data();
}

}  // namespace mortise
