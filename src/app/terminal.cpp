#include "app/terminal.hpp"

#include "base/printable.hpp"

namespace mortise {

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
