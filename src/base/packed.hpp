// Numbers, texts and lists as bytes, one after the other: of one program, for itself.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mortise {

class Packed {
 public:
  std::string bytes;

  void put(std::int64_t number) { append(&number, sizeof number); }
  void put(const std::string& text) { put(text.data(), text.size()); }
  template <typename Number>
  void put(const Number* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Number>);
    put(static_cast<std::int64_t>(count));
    append(first, count * sizeof(Number));
  }

 private:
  void append(const void* from, std::size_t count) { bytes.append(static_cast<const char*>(from), count); }
};

/// Reads them again, in the same order. Throws std::out_of_range where they end too early.
class Unpacked {
 public:
  explicit Unpacked(std::string_view bytes) : bytes_(bytes) {}

  std::int64_t number() {
    std::int64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(std::size_t(number()))); }
  template <typename Number>
  std::vector<Number> list() {
    static_assert(std::is_trivially_copyable_v<Number>);
    const auto count = std::size_t(number());
    if (count > bytes_.size() / sizeof(Number)) throw std::out_of_range("packed list");
    const std::string_view from = take(count * sizeof(Number));
    std::vector<Number> values(count);
    if (count > 0) std::memcpy(values.data(), from.data(), from.size());
    return values;
  }
  /// What has not been read yet.
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) throw std::out_of_range("packed bytes");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view bytes_;
};

}  // namespace mortise
