// Output to the terminal, with unsafe characters escaped.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace mortise {

/// While it lives, what is written to the stream has its control characters escaped (printable), line breaks apart:
/// names and titles come from files of others, and a terminal obeys what it is sent.
class PrintableStream : private std::streambuf {
 public:
  explicit PrintableStream(std::ostream& stream);
  ~PrintableStream() override;
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  int_type overflow(int_type c) override;
  int sync() override;
  /// All but the line that is not yet ended, or (`everything`) that too.
  bool pass_on(bool everything);

  std::ostream& stream_;
  std::streambuf* target_;
  std::string pending_;
};

inline constexpr std::size_t terminal_columns = 100;

/// The text as a terminal shows it: lines of more columns broken at spaces and set below their second column, control
/// characters escaped, and with `colour` the title, the verdict, warnings and what fails set off.
std::string for_terminal(const std::string& text, bool colour);

/// Writes to the standard output: as it is into files and pipes, for_terminal to a terminal, where NO_COLOR
/// (https://no-color.org) or TERM=dumb leaves the colours out.
void say(const std::string& text);

/// The stages of a run on one line of the terminal (the standard error) as they begin, wiped at the end; nothing into
/// files and pipes, or if it is to be quiet.
class StageLine {
 public:
  explicit StageLine(bool quiet);
  ~StageLine();
  StageLine(const StageLine&) = delete;
  StageLine& operator=(const StageLine&) = delete;
  void operator()(const std::string& stage) const;

 private:
  bool active_;
};

}  // namespace mortise
