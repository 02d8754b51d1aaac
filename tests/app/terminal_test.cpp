// What a terminal is shown. (What goes into pipes: command_line_test.cpp.)
#include "app/terminal.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace mortise::test {
namespace {

std::string repeated(const std::string& word, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += word;
  return text;
}

TEST(Terminal, ShortLinesAreShownAsTheyAre) {
  const std::string text = "A title\n  solved; results in out/\n  mesh      4 nodes\n";
  EXPECT_EQ(for_terminal(text, false), text);
}

TEST(Terminal, NoLineIsWiderThanTheTerminalAndEveryWordIsThere) {
  const std::string text = "  model     " + repeated("word ", 60) + "\n            " + repeated("other ", 40) + "end\n";
  std::istringstream shown(for_terminal(text, false));
  int words = 0;
  for (std::string line; std::getline(shown, line);) {
    EXPECT_LE(line.size(), terminal_columns);
    EXPECT_EQ(line.find_first_not_of(' '), line.starts_with("  model") ? 2U : 12U) << line;
    std::istringstream parts(line);
    for (std::string word; parts >> word;) ++words;
  }
  EXPECT_EQ(words, 1 + 60 + 40 + 1);
}

TEST(Terminal, CharactersAreCountedNotBytes) {
  const std::string line = "  " + repeated("\u03c3", 48) + " " + repeated("\u03bb", 49);  // 100 of them, 197 bytes
  EXPECT_EQ(for_terminal(line + "\n", false), line + "\n");
  EXPECT_EQ(for_terminal(line + "\u03bb\n", false), line.substr(0, 98) + "\n  " + repeated("\u03bb", 50) + "\n");
}

TEST(Terminal, ALongWordStaysWhole) {
  const std::string line = "  " + repeated("x", 300);
  EXPECT_EQ(for_terminal(line + "\n", false), line + "\n");
}

TEST(Terminal, VerdictAndWarningsAreSetOff) {
  EXPECT_EQ(for_terminal("A title\n  solved; results\n  mesh      4\n  warning   w\n  FAILED    f\n", true),
            "\033[1mA title\033[0m\n\033[32m  solved; results\033[0m\n  mesh      4\n\033[33m  warning   w\033[0m\n"
            "\033[1;31m  FAILED    f\033[0m\n");
}

TEST(Terminal, IsNotSteeredByTheText) {
  EXPECT_EQ(for_terminal("title\n  mesh      \033[31mred\n", false), "title\n  mesh      \\x1b[31mred\n");
}

}  // namespace
}  // namespace mortise::test
