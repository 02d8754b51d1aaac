// The terminal's text of a run: the report (results/report.hpp) in lines for people.
#pragma once

#include "results/report.hpp"

namespace mortise {

/// At most one screen, the verdict below the title.
std::string report_text(const Json& report, const std::filesystem::path& folder);

/// Its "model": plane and materials, then a line a support, tie, load and field; of many the first ones.
std::string model_text(const Json& model);

/// Its pairs: three lines each; of more than told_in_full (base/printable.hpp) what they are together, and which of
/// them has the lowest and the highest p and the largest force.
std::string contact_text(const Json& report);

}  // namespace mortise
