#include "app/version.hpp"

#include <string_view>

#include "solve/dense_kernel.hpp"

namespace mortise {

std::string version_text() {
  const std::string commit = std::string_view(MORTISE_COMMIT).empty() ? "" : " (commit " MORTISE_COMMIT ")";
  return "mortise " MORTISE_VERSION + commit + "\n" MORTISE_LIBRARIES "\n" + dense_kernel();
}

}  // namespace mortise
