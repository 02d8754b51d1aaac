// The heap of the tests' process, which starts as the program does (support/process.cpp).
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace mortise {
namespace {

// VmFlags of the mapping that has this address (proc(5), smaps).
std::string flags_at(const void* address) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t from, to;
    char dash;
    if (words >> std::hex >> from >> dash >> to && dash == '-') here = from <= wanted && wanted < to;
    if (here && line.starts_with("VmFlags:")) return line;
  }
  return "";
}

TEST(LargePages, HoldWhatIsAllocatedAndKeepItWhenItIsFreed) {
  rlimit addresses{};
  getrlimit(RLIMIT_AS, &addresses);
  if (addresses.rlim_cur != RLIM_INFINITY) GTEST_SKIP() << "The address space is limited";
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) GTEST_SKIP() << "The kernel has no large pages";
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "The sanitizer has a heap of its own";
#endif
  const char* place = nullptr;
  {
    const std::vector<char> block(20 << 20);  // larger than what glibc takes from the heap unless it is told
    place = block.data() + block.size() / 2;
    EXPECT_NE(flags_at(place).find(" hg"), std::string::npos) << flags_at(place);
  }
  place += 1 << 29;  // of the gigabyte that was reserved: what is free at the heap's end goes back first
  EXPECT_NE(flags_at(place).find(" hg"), std::string::npos) << "given back to the system";
}

}  // namespace
}  // namespace mortise
