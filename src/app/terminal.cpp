#include "app/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <vector>

#include "base/printable.hpp"

namespace mortise {
namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

// Bytes of the first so many characters, or of all of them.
std::size_t bytes_of(const std::string& text, std::size_t characters) {
  std::size_t at = 0;
  for (; at < text.size(); ++at)
    if (!continues_character(text[at]) && characters-- == 0) break;
  return at;
}

// Where the second column of a line begins, as of "  mesh      4 nodes"; of a line without, where its text does.
std::size_t second_column(const std::string& line) {
  const std::size_t text = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", text);
  const std::size_t second = gap == std::string::npos ? gap : line.find_first_not_of(' ', gap);
  return second < terminal_columns / 2 ? second : text < terminal_columns / 2 ? text : 0;
}

std::vector<std::string> broken(const std::string& line) {
  const std::string margin(second_column(line), ' ');
  std::vector<std::string> lines;
  std::string rest = line;
  while (bytes_of(rest, terminal_columns) < rest.size()) {
    const std::size_t most = bytes_of(rest, terminal_columns + 1);
    const std::size_t space = rest.rfind(' ', most - 1);
    if (space == std::string::npos || space <= margin.size()) break;  // one long word
    lines.push_back(rest.substr(0, space));
    rest = margin + rest.substr(space + 1);
  }
  lines.push_back(rest);
  return lines;
}

// The code of a line's colour; empty: none.
std::string colour_of(const std::string& line, bool title) {
  if (title) return "1";                            // bold
  if (line.starts_with("  solved;")) return "32";   // green
  if (line.starts_with("  warning ")) return "33";  // yellow
  for (const char* bad : {"  accuracy_not_reached;", "  check_failed;", "  not_converged;", "  FAILED "})
    if (line.starts_with(bad)) return "1;31";  // red
  return "";
}

// Past PrintableStream: these control characters are our own.
void write(std::FILE* file, const std::string& text) {
  std::fputs(text.c_str(), file);
  std::fflush(file);
}

bool coloured() {
  const auto value = [](const char* name) {
    const char* text = std::getenv(name);
    return std::string(text ? text : "");
  };
  return value("NO_COLOR").empty() && value("TERM") != "dumb";
}

}  // namespace

std::string for_terminal(const std::string& text, bool colour) {
  std::istringstream lines(text);
  std::string shown;
  bool title = true;
  for (std::string line; std::getline(lines, line); title = false) {
    const std::string code = colour ? colour_of(line, title) : "";
    for (const std::string& part : broken(printable(line)))
      shown += (code.empty() ? part : "\033[" + code + "m" + part + "\033[0m") + "\n";
  }
  return shown;
}

void say(const std::string& text) {
  if (isatty(STDOUT_FILENO)) {
    std::cout.flush();
    write(stdout, for_terminal(text, coloured()));
  } else {
    std::cout << text;
  }
}

StageLine::StageLine(bool quiet) : active_(!quiet && isatty(STDERR_FILENO)) {}

StageLine::~StageLine() {
  if (active_) write(stderr, "\r\033[K");
}

void StageLine::operator()(const std::string& stage) const {
  const std::string text = printable(stage) + " ...";
  if (active_) write(stderr, "\r\033[K" + text.substr(0, bytes_of(text, terminal_columns - 1)));
}

PrintableStream::PrintableStream(std::ostream& stream) : stream_(stream), target_(stream.rdbuf(this)) {}

PrintableStream::~PrintableStream() {
  pass_on(true);
  target_->pubsync();
  stream_.rdbuf(target_);
}

PrintableStream::int_type PrintableStream::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  pending_ += traits_type::to_char_type(c);
  return c != '\n' || pass_on(false) ? c : traits_type::eof();
}

int PrintableStream::sync() { return pass_on(true) && target_->pubsync() == 0 ? 0 : -1; }

bool PrintableStream::pass_on(bool everything) {
  const bool ended = !pending_.empty() && pending_.back() == '\n';
  if (!ended && !everything) return true;
  if (ended) pending_.pop_back();
  const std::string text = printable(pending_) + (ended ? "\n" : "");
  pending_.clear();
  const auto count = static_cast<std::streamsize>(text.size());
  return target_->sputn(text.data(), count) == count;
}

}  // namespace mortise
