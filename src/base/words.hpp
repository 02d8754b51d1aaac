// Enums that people read and write by the names of their values.
#pragma once

#include <string>
#include <vector>

#include "base/csv_fields.hpp"

/// enum class NAME { ... }; to_string(NAME), a value as its word; all_of(NAME{}), the values in their order.
#define MORTISE_WORDS(NAME, ...)                                                                      \
  enum class NAME { __VA_ARGS__ };                                                                    \
  inline std::string to_string(NAME value) {                                                          \
    return std::string(::mortise::csv_fields(#__VA_ARGS__, ',').at(static_cast<std::size_t>(value))); \
  }                                                                                                   \
  inline std::vector<NAME> all_of(NAME) {                                                             \
    using enum NAME;                                                                                  \
    return {__VA_ARGS__};                                                                             \
  }
