// Names with stars for any letters: "block_*".
#pragma once

#include <string>

namespace mortise {

inline bool is_pattern(const std::string& name) { return name.find('*') != std::string::npos; }

/// Whether the name is the pattern with something, or nothing, for each star.
bool matches(const std::string& pattern, const std::string& name);

/// Whether some name matches both; names and patterns alike.
bool share_a_name(const std::string& first, const std::string& second);

}  // namespace mortise
