#include "mesh_files/msh_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_space(char c) { return is_blank(c) || c == '\n'; }

/// The whole file; errno says why not.
bool read_whole(const std::string& file, std::string& text) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct stat status {};
  bool good = fstat(descriptor, &status) == 0;
  if (good && !S_ISREG(status.st_mode)) {
    errno = EINVAL;
    good = false;
  }
  if (good) text.resize(status.st_size);
  std::size_t done = 0;
  while (good && done < text.size()) {
    const ssize_t part = ::read(descriptor, text.data() + done, text.size() - done);
    if (part == 0) break;  // somebody made it shorter
    if (part > 0) done += static_cast<std::size_t>(part);
    good = part > 0 || errno == EINTR;
  }
  text.resize(done);
  ::close(descriptor);
  return good;
}

}  // namespace

MshInput::MshInput(std::string file) : file_(std::move(file)) {
  if (!read_whole(file_, text_)) throw InputError(file_ + ": cannot be read: " + std::strerror(errno));
}

void MshInput::fail_at(std::size_t record, const std::string& trouble) const {
  std::string place = ", byte " + std::to_string(record);
  if (!binary_) {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(record, text_.size()));
    place = ", line " + std::to_string(1 + std::count(text_.begin(), end, '\n'));
  }
  throw InputError(printable(file_ + place + (section_.empty() ? "" : ", ") + section_ + ": " + trouble));
}

void MshInput::fail_token(const char* what) const {
  std::size_t end = at_;
  while (end < text_.size() && !is_space(text_[end]) && end - at_ < 40) ++end;
  const std::string found = end > at_             ? "'" + text_.substr(at_, end - at_) + "'"
                            : end == text_.size() ? "the end of the file"
                                                  : "the end of the line";
  fail_at(at_, std::string("expected ") + what + ", found " + found);
}

void MshInput::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

void MshInput::begin_record() {
  if (!binary_) {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  record_ = at_;
}

void MshInput::end_record() {
  if (binary_) return;
  skip_blanks();
  if (at_ < text_.size() && text_[at_] != '\n') fail_token("the end of the line");
}

void MshInput::end_line() {
  end_record();
  at_ = std::min(at_ + 1, text_.size());
}

bool MshInput::at_end_of_token() const { return at_ == text_.size() || is_space(text_[at_]); }

template <typename T>
T MshInput::raw(const char* what) {
  if (text_.size() - at_ < sizeof(T)) fail_at(at_, std::string("expected ") + what + ", found the end of the file");
  T value;
  std::memcpy(&value, text_.data() + at_, sizeof(T));
  at_ += sizeof(T);
  return value;
}

std::int64_t MshInput::text_integer(const char* what) {
  skip_blanks();
  const std::size_t start = at_;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
  at_ = static_cast<std::size_t>(end - text_.data());
  if (error == std::errc() && at_end_of_token()) return value;
  at_ = start;
  fail_token(what);
}

std::int64_t MshInput::integer(const char* what) { return binary_ ? raw<std::int32_t>(what) : text_integer(what); }

std::int64_t MshInput::size(const char* what) { return binary_ ? raw<std::int64_t>(what) : text_integer(what); }

double MshInput::real(const char* what) {
  double value = 0;
  const std::size_t before = at_;
  if (binary_) {
    value = raw<double>(what);
  } else {
    skip_blanks();
    const std::size_t start = at_;
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(end - text_.data());
    // Smaller than the smallest double: it is zero.
    const std::string_view token = std::string_view(text_).substr(start, at_ - start);
    const bool tiny =
        error == std::errc::result_out_of_range && (token.find("e-") != token.npos || token.find("E-") != token.npos);
    if (tiny) value = 0;
    if ((error != std::errc() && !tiny) || !at_end_of_token()) {
      at_ = start;
      fail_token(what);
    }
  }
  if (!std::isfinite(value)) fail_at(before, std::string(what) + " is not a finite number");
  return value;
}

std::int64_t MshInput::count(const char* what, std::size_t text_bytes, std::size_t binary_bytes) {
  const std::size_t start = at_;
  const std::int64_t value = size(what);
  const auto room = static_cast<std::int64_t>((text_.size() - at_) / (binary_ ? binary_bytes : text_bytes));
  if (value < 0) fail_at(start, std::string(what) + " is " + std::to_string(value) + "; expected 0 or more");
  if (value > room) {
    fail_at(start, std::string(what) + " is " + std::to_string(value) + ", but the file has room for no more than " +
                       std::to_string(room));
  }
  return value;
}

std::int64_t MshInput::count_line(const char* what, std::size_t text_bytes, std::size_t binary_bytes) {
  const bool binary = std::exchange(binary_, false);
  begin_record();
  const std::int64_t value = count(what, binary ? binary_bytes : text_bytes, 1);
  end_line();
  binary_ = binary;
  return value;
}

bool MshInput::next_whole_line(std::string_view& line) {
  record_ = at_;
  if (at_ == text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  at_ = std::min(end + 1, text_.size());
  line = std::string_view(text_).substr(record_, end - record_);
  return true;
}

bool MshInput::next_line(std::string_view& line) {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  if (!next_whole_line(line)) return false;
  while (is_blank(line.back())) line.remove_suffix(1);
  return true;
}

bool MshInput::at_line(std::string_view line) {
  const std::size_t before = at_;
  std::string_view found;
  if (next_line(found) && found == line) return true;
  at_ = before;
  return false;
}

bool MshInput::skip_to(const std::string& line) {
  for (std::size_t found = text_.find(line, at_); found != std::string::npos; found = text_.find(line, found + 1)) {
    const std::size_t end = found + line.size();
    if ((found == 0 || text_[found - 1] == '\n') && (end == text_.size() || is_space(text_[end]))) {
      at_ = end;
      return true;
    }
  }
  return false;
}

}  // namespace mortise
