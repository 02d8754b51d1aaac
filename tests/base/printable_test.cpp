#include "base/printable.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

TEST(Printable, PlainTextStaysAsItIs) {
  for (const char* text : {"", "a b", "C:\\n", "Überlastung, 3 µm, 接触"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreWrittenOut) {
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable("\x1b[31mred\x7f"), "\\x1b[31mred\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"), "\\x9b");  // U+009B, which starts a command as ESC [ does
  EXPECT_EQ(printable(std::string("\0", 1)), "\\x00");
}

}  // namespace
}  // namespace mortise
