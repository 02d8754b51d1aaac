// Text of others on its way to a terminal.
#pragma once

#include <string>

namespace mortise {

/// The text with line breaks, tabs and all other control characters (C0, DEL and, in UTF-8, C1) written as \n, \t,
/// \x1b: one line that cannot steer a terminal. Text without them comes back as it is.
std::string printable(const std::string& text);

}  // namespace mortise
