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

TEST(Printable, WhatTurnsALineRoundOrIsNoUtf8IsWrittenOut) {
  EXPECT_EQ(printable("\u202e left"), "\\u202e left");
  EXPECT_EQ(printable("\xff\xc3(\xe2\x82"), "\\xff\\xc3(\\xe2\\x82");
  EXPECT_EQ(printable("\xc0\x8a\xed\xa0\x80"), "\\xc0\\x8a\\xed\\xa0\\x80");  // overlong, a surrogate
}

TEST(InShort, ALongLineLosesItsMiddle) {
  EXPECT_EQ(in_short("short"), "short");
  const std::string line = "start " + std::string(5000, 'x') + " end";
  EXPECT_LT(in_short(line).size(), 1000u);
  EXPECT_EQ(in_short(line).substr(0, 6), "start ");
  EXPECT_TRUE(in_short(line).ends_with(" end"));
}

TEST(Percent, HasTwoDigitsAndNoPowerOfTen) {
  EXPECT_EQ(percent(0.000123), "0.012 %");
  EXPECT_EQ(percent(0.0123), "1.2 %");
  EXPECT_EQ(percent(0.994), "99 %");
  EXPECT_EQ(percent(0.996), "100 %");
  EXPECT_EQ(percent(3.12), "310 %");
  EXPECT_EQ(percent(9.99), "1000 %");
  EXPECT_EQ(percent(200), "more than 1000 %");
  EXPECT_EQ(two_digits(1.234), "1.2");
}

}  // namespace
}  // namespace mortise
