#include "base/memory_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace mortise {
namespace {

TEST(MemoryFile, HoldsWhatIsWrittenToItsPath) {
  const std::string long_text(100000, 'x');
  const MemoryFile file(long_text);
  EXPECT_EQ(file.text(), long_text);
  std::ofstream(file.path()) << "other";
  EXPECT_EQ(file.text(), "other");
}

}  // namespace
}  // namespace mortise
