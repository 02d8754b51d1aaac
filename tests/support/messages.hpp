// What errors say.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/errors.hpp"

namespace mortise::test {

/// what() of the Error that `step` throws; a note if it throws none.
template <typename Error = InputError, typename Step>
std::string message_of(Step step) {
  try {
    step();
  } catch (const Error& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

}  // namespace mortise::test
