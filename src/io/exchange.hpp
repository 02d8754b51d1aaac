// Two folders change places.
#pragma once

#include <filesystem>

namespace mortise {

/// In one atomic step where the file system can; else in three. Throws std::filesystem::filesystem_error.
void exchange_folders(const std::filesystem::path& a, const std::filesystem::path& b);

/// By way of `aside`, a third name in the same folder, which must be free. Killed half-way, `b` is found at `aside`.
void exchange_folders_in_steps(const std::filesystem::path& a, const std::filesystem::path& b,
                               const std::filesystem::path& aside);

/// The name that exchange_folders moves `b` to when it needs one.
std::filesystem::path aside_of(const std::filesystem::path& a);

}  // namespace mortise
