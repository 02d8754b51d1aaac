#include "base/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <sstream>
#include <stdexcept>

#include "base/printable.hpp"

namespace mortise {
namespace {

using Clock = std::chrono::steady_clock;

/// What a reply holds behind its length: its first byte.
enum Kind : char {
  result = 'r',
  input_error = 'i',
  domain_error = 'd',
  no_memory = 'm',
  failure = 'f',
  forbidden = 'a'
};

int reply_end = -1;  // in the child: where its reply goes

struct Pipe {
  int in = -1, out = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe failed: " + std::string(strerror(errno)));
    out = ends[0];
    in = ends[1];
  }
  ~Pipe() {
    ::close(out);
    if (in >= 0) ::close(in);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

// ---- In the child ----

void write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

/// Its length, its kind, its bytes.
[[noreturn]] void reply(Kind kind, const char* bytes, std::size_t count) {
  const std::size_t length = count + 1;
  const char first = kind;
  write_all(reply_end, reinterpret_cast<const char*>(&length), sizeof length);
  write_all(reply_end, &first, 1);
  write_all(reply_end, bytes, count);
  ::_exit(0);
}

[[noreturn]] void reply(Kind kind, const std::string& bytes) { reply(kind, bytes.data(), bytes.size()); }

/// Handlers, a core file, exit handlers of the program that it was forked from: none is the child's business.
void leave_parent(pid_t parent, const Pipe& answer, const Pipe& text) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  ::setpgid(0, 0);
  for (const int number :
       {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM, SIGCHLD})
    ::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // gmsh lifts the limit of its stack as far as it may, and a recursion without end would fill the memory.
  constexpr rlim_t largest_stack = 1 << 30;
  rlimit stack{};
  ::getrlimit(RLIMIT_STACK, &stack);
  stack.rlim_max = std::min(stack.rlim_max, largest_stack);
  stack.rlim_cur = std::min(stack.rlim_cur, stack.rlim_max);
  ::setrlimit(RLIMIT_STACK, &stack);
  std::atexit([] { ::_exit(1); });  // the first to be called
  reply_end = answer.in;
  ::dup2(text.in, STDOUT_FILENO);
  ::dup2(text.in, STDERR_FILENO);
}

[[noreturn]] void work_and_reply(const std::function<std::string()>& work) {
  try {
    reply(result, work());
  } catch (const InputError& error) {
    reply(input_error, error.what());
  } catch (const std::domain_error& error) {
    reply(domain_error, error.what());
  } catch (const std::bad_alloc&) {
    reply(no_memory, "");
  } catch (const std::exception& error) {
    reply(failure, error.what());
  } catch (...) {
    reply(failure, "failed without a message");
  }
}

// ---- In the parent ----

/// The child, killed with all that it has started unless it has been waited for.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ > 0) kill_all();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void kill_all() {
    ::kill(-id_, SIGKILL);
    ::kill(id_, SIGKILL);  // it may not have its group yet
    wait();
  }
  /// Its status; 0 if somebody else has waited for it.
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

 private:
  pid_t id_;
};

/// The end of what the child has written to its standard output and error.
class LastWords {
 public:
  void add(const char* bytes, std::size_t count) {
    text_.append(bytes, count);
    if (text_.size() > 2 * kept) text_.erase(0, text_.size() - kept);
  }
  /// "; the last message: ...", without colours; empty if there is none.
  std::string shown() const {
    std::string plain;
    for (std::size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] == '\033')
        i = std::min(text_.find('m', i), text_.size() - 1);
      else
        plain += text_[i];
    }
    std::istringstream lines(plain);
    std::string last;
    for (std::string line; std::getline(lines, line);)
      if (const std::size_t first = line.find_first_not_of(" \r\t"); first != std::string::npos)
        last = line.substr(first, line.find_last_not_of(" \r\t") + 1 - first);
    return last.empty() ? "" : "; the last message: " + printable(last);
  }

 private:
  static constexpr std::size_t kept = 4096;
  std::string text_;
};

/// Reads what is there; false at the end.
template <typename Take>
bool read_some(int file, const Take& take) {
  std::array<char, 65536> part;
  const ssize_t count = ::read(file, part.data(), part.size());
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  take(part.data(), static_cast<std::size_t>(count));
  return count > 0;
}

bool whole(const std::string& answer) {
  std::size_t length = 0;
  if (answer.size() < sizeof length) return false;
  std::memcpy(&length, answer.data(), sizeof length);
  return answer.size() == sizeof length + length;
}

/// Until the answer is whole, the child has ended or the time is over: then false.
bool read_answer(const Pipe& from, const Pipe& text, Clock::time_point end, std::string& answer, LastWords& words) {
  constexpr long longest_wait = 1000000;  // milliseconds, in the range of an int
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    std::array<pollfd, 2> files{pollfd{from.out, POLLIN, 0}, pollfd{text.out, POLLIN, 0}};
    ::poll(files.data(), files.size(), int(std::min<long>(left, longest_wait)));
    if (files[1].revents & POLLIN)
      read_some(text.out, [&](const char* bytes, std::size_t count) { words.add(bytes, count); });
    if ((files[0].revents & (POLLIN | POLLHUP)) &&
        !read_some(from.out, [&](const char* bytes, std::size_t count) { answer.append(bytes, count); }))
      return true;
    if (whole(answer)) return true;
  }
}

std::string end_in_words(int status) {
  if (!WIFSIGNALED(status)) return "ended the program, as the commands Exit and Abort do; remove them";
  switch (WTERMSIG(status)) {
    case SIGSEGV:
    case SIGBUS:
    case SIGILL:
      return "crashed (segmentation fault, or a recursion without end)";
    case SIGABRT:
      return "gave up (abort)";
    case SIGFPE:
      return "crashed (floating-point exception)";
    case SIGKILL:
      return "was killed, as a machine without memory left does";
    default:
      return "was ended by signal " + std::to_string(WTERMSIG(status));
  }
}

std::string result_of(const std::string& answer) {
  const auto kind = static_cast<Kind>(answer[sizeof(std::size_t)]);
  std::string bytes = answer.substr(sizeof(std::size_t) + 1);
  switch (kind) {
    case result:
      return bytes;
    case input_error:
      throw InputError(bytes);
    case domain_error:
      throw std::domain_error(bytes);
    case no_memory:
      throw std::bad_alloc();
    case forbidden:
      throw ForbiddenAct(bytes);
    default:
      throw std::runtime_error(bytes);
  }
}

std::string seconds_in_words(double seconds) { return worded(seconds, " seconds"); }

}  // namespace

void end_child_by_forbidden_act(const char* act) { reply(forbidden, act, std::strlen(act)); }

std::string run_in_child(const ChildWork& child, const std::function<std::string()>& work) {
  constexpr double longest = 1e8;  // seconds that a time_point can be ahead
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(std::min(child.seconds, longest)));
  Pipe from, text;
  std::fflush(stdout);
  std::fflush(stderr);
  const pid_t parent = ::getpid(), id = ::fork();
  if (id < 0) throw std::runtime_error("fork failed: " + std::string(strerror(errno)));
  if (id == 0) {
    leave_parent(parent, from, text);
    work_and_reply(work);
  }
  Child process(id);
  for (Pipe* pipe : {&from, &text}) {
    ::close(pipe->in);
    pipe->in = -1;
  }
  ::fcntl(text.out, F_SETFL, O_NONBLOCK);
  std::string answer;
  LastWords words;
  const std::string start = child.file + ": " + child.library + " ";
  if (!read_answer(from, text, end, answer, words)) {
    process.kill_all();
    throw InputError(start + "took longer than " + child.limit + seconds_in_words(child.seconds) + words.shown());
  }
  const int status = process.wait();
  if (whole(answer)) return result_of(answer);
  // The sandbox's signal, where it was blocked: posix_spawn and system do so.
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS) throw ForbiddenAct("runs a program");
  while (read_some(text.out, [&](const char* bytes, std::size_t count) { words.add(bytes, count); }) &&
         errno != EAGAIN) {
  }
  throw InputError(start + end_in_words(status) + words.shown());
}

}  // namespace mortise
