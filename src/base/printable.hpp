// Text for messages.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// The text with line breaks, tabs and all other control characters written as \n, \t, \x1b, bytes that are no UTF-8
/// as \xff, and characters that turn a line round or cannot be seen as \u202e: one line that cannot steer a terminal.
/// Text without them comes back as it is.
std::string printable(const std::string& text);

/// A line of more than 900 bytes without its middle.
std::string in_short(const std::string& line);

/// A list on the terminal shows up to so many entries, else the first three and how many more there are.
inline constexpr std::size_t told_in_full = 6, told_of_many = 3;

/// "a, b, c", or "a, b, c and 397 more".
std::string listed(const std::vector<std::string>& names);

/// Puts more lines behind the lines.
void append_lines(std::vector<std::string>& lines, const std::vector<std::string>& more);

/// "1.2 %" of 0.012, "310 %", "more than 1000 %": two digits, and never as 3.1e+02.
std::string percent(double part);

/// "1.2"
std::string two_digits(double value);

/// The shortest decimal that reads back as the same number.
std::string shortest(double number);

/// The parts as a stream prints them, one behind the other: numbers with six digits.
template <class... Parts>
std::string worded(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// "near (0.4, 0.3)": where to look in the mesh, six digits.
std::string near_point(const Vec2& point);

}  // namespace mortise
