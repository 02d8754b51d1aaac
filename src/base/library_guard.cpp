#include "base/library_guard.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>

#include "base/printable.hpp"

namespace mortise {
namespace {

constexpr std::array signals{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGALRM};

/// What the handlers need, ready made: in a process that has crashed nothing may be allocated.
struct Armed {
  std::atomic<bool> on = false;
  int output = -1;                 // what the library writes
  int error = -1;                  // the standard error of before
  std::array<char, 4096> start{};  // "mortise: error: FILE: LIBRARY "
  std::array<char, 80> late{};     // what is said of the time limit
};
Armed armed;

/// Cut to fit.
template <std::size_t n>
void keep(std::array<char, n>& place, const std::string& text) {
  const std::size_t count = std::min(text.size(), n - 1);
  std::memcpy(place.data(), text.data(), count);
  place[count] = '\0';
}

// ---- From here to the end of the namespace: only what may be called in a signal handler ----

void say(const char* text, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(armed.error, text, count);
    if (written <= 0) return;
    text += written;
    count -= static_cast<std::size_t>(written);
  }
}

void say(const char* text) { say(text, std::strlen(text)); }

/// The last line that it wrote, without colours and its own "Error   : ".
void say_last_message() {
  std::array<char, 600> tail;
  const off_t end = ::lseek(armed.output, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, end - static_cast<off_t>(tail.size()));
  const ssize_t count = ::pread(armed.output, tail.data(), tail.size(), from);
  if (count <= 0) return;
  const auto is_text = [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; };
  char* last = tail.data() + count;
  while (last > tail.data() && (!is_text(last[-1]) || last[-1] == ' ')) --last;
  char* first = last;
  while (first > tail.data() && first[-1] != '\n') --first;
  for (char* c = first; c < last; ++c) {
    if (*c == '\033') {  // a colour: up to the letter m
      while (c < last && *c != 'm') *c++ = ' ';
      if (c < last) *c = ' ';
    } else if (!is_text(*c)) {
      *c = '?';
    }
  }
  while (last > first && last[-1] == ' ') --last;
  while (first < last && *first == ' ') ++first;
  if (first == last) return;
  say("; the last message: ");
  say(first, static_cast<std::size_t>(last - first));
}

[[noreturn]] void end_process(const char* what) {
  armed.on = false;
  say(armed.start.data());
  say(what);
  say_last_message();
  say("\n");
  ::_exit(1);
}

void on_signal(int number) {
  if (!armed.on) ::_exit(1);  // a second signal while the first is being told
  switch (number) {
    case SIGALRM:
      end_process(armed.late.data());
    case SIGABRT:
      end_process("gave up (abort)");
    case SIGFPE:
      end_process("crashed (floating-point exception)");
    default:
      end_process("crashed (segmentation fault, or a recursion without end)");
  }
}

void at_exit() {
  if (armed.on) end_process("ended the program, as the commands Exit and Abort do; remove them");
}

}  // namespace

LibraryGuard::LibraryGuard(const std::string& file, double seconds, const std::string& library,
                           const std::string& limit)
    : stack_(64 * 1024) {
  static const int registered = std::atexit(at_exit);
  if (registered != 0) throw std::runtime_error("atexit failed");
  keep(armed.start, "mortise: error: " + printable(file) + ": " + library + " ");
  std::array<char, 80> late{};
  std::snprintf(late.data(), late.size(), "took longer than %s%g seconds", limit.c_str(), seconds);
  armed.late = late;

  std::cout.flush();
  std::fflush(stdout);
  std::fflush(stderr);
  old_output_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  old_error_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  armed.error = old_error_;
  armed.output = ::memfd_create("mortise", MFD_CLOEXEC);
  ::fcntl(armed.output, F_SETFL, O_APPEND);
  ::dup2(armed.output, STDOUT_FILENO);
  ::dup2(armed.output, STDERR_FILENO);

  stack_t stack{};
  stack.ss_sp = stack_.data();
  stack.ss_size = stack_.size();
  ::sigaltstack(&stack, &old_stack_);
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_ONSTACK;
  old_actions_.resize(signals.size());
  armed.on = true;
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &action, &old_actions_[i]);

  itimerval timer{};
  const double most = std::clamp(seconds, 1e-3, 1e8);
  timer.it_value.tv_sec = static_cast<time_t>(most);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (most - std::floor(most)));
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

LibraryGuard::~LibraryGuard() {
  const itimerval none{};
  ::setitimer(ITIMER_REAL, &none, nullptr);
  armed.on = false;
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &old_actions_[i], nullptr);
  ::sigaltstack(&old_stack_, nullptr);
  std::cout.flush();
  std::fflush(stdout);
  std::fflush(stderr);
  const auto put_back = [](int old, int standard) {
    if (old < 0) {
      ::close(standard);  // it was closed before
      return;
    }
    ::dup2(old, standard);
    ::close(old);
  };
  put_back(old_output_, STDOUT_FILENO);
  put_back(old_error_, STDERR_FILENO);
  ::close(armed.output);
}

}  // namespace mortise
