// Which mortise this is.
#pragma once

#include <string>

namespace mortise {

/// "mortise 0.1.0 (commit 1a2b3c4)", and lines of the libraries that it was built with and of the dense kernel in use.
std::string version_text();

}  // namespace mortise
