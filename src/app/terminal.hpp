// What mortise says, made safe on its way out.
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

}  // namespace mortise
