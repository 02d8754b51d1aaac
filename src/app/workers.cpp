#include "app/workers.hpp"

#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <vector>

#include "base/printable.hpp"

namespace mortise {
namespace {

/// The number of the next piece of work, in memory that all processes see.
class Counter {
 public:
  Counter() {
    void* const place =
        ::mmap(nullptr, sizeof(std::atomic<std::size_t>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) throw std::bad_alloc();
    next_ = new (place) std::atomic<std::size_t>(0);
  }
  ~Counter() { ::munmap(next_, sizeof *next_); }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  std::size_t next() { return (*next_)++; }

 private:
  std::atomic<std::size_t>* next_;
};

struct Worker {
  pid_t process;
  int pipe;          // its answers
  std::string text;  // of which no line is complete
};

void write_all(int pipe, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(pipe, text.data() + at, text.size() - at);
    if (written <= 0) ::_exit(1);  // nobody listens any more
    at += static_cast<std::size_t>(written);
  }
}

[[noreturn]] void work_and_exit(int pipe, pid_t parent, std::size_t count, Counter& counter,
                                const std::function<void(std::size_t, const Answer&)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);
  try {
    for (std::size_t i = counter.next(); i < count; i = counter.next())
      work(i, [&](const std::string& line) { write_all(pipe, line + "\n"); });
  } catch (const std::exception& error) {
    std::cerr << "mortise: error: " << printable(error.what()) << std::endl;
    ::_exit(3);
  }
  ::_exit(0);
}

Worker start(std::size_t count, Counter& counter, const std::function<void(std::size_t, const Answer&)>& work) {
  std::array<int, 2> ends{};
  const pid_t parent = ::getpid();
  std::cout.flush();
  std::cerr.flush();
  if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) work_and_exit(ends[1], parent, count, counter, work);
  ::close(ends[1]);
  return {process, ends[0], {}};
}

/// What has come from it, line by line; false at the end.
bool read_some(Worker& worker, const std::function<void(const std::string&)>& take) {
  std::array<char, 1 << 16> block;
  const ssize_t count = ::read(worker.pipe, block.data(), block.size());
  if (count <= 0) return false;
  worker.text.append(block.data(), static_cast<std::size_t>(count));
  for (std::size_t end; (end = worker.text.find('\n')) != std::string::npos; worker.text.erase(0, end + 1))
    take(worker.text.substr(0, end));
  return true;
}

/// Waits for its end; whether all went well.
bool end_of(const Worker& worker) {
  int status = 0;
  ::close(worker.pipe);
  return ::waitpid(worker.process, &status, 0) == worker.process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Ends what is left of the processes.
class Crew {
 public:
  std::vector<Worker> workers;

  Crew() = default;
  ~Crew() {
    for (const Worker& worker : workers) ::kill(worker.process, SIGTERM);
    for (const Worker& worker : workers) end_of(worker);
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
};

}  // namespace

bool share_work(std::size_t count, int processes, const std::function<void(std::size_t, const Answer&)>& work,
                const std::function<void(const std::string& line)>& take) {
  if (processes == 1) {
    for (std::size_t i = 0; i < count; ++i) work(i, take);
    return true;
  }
  Counter counter;
  Crew crew;
  for (std::size_t k = 0; k < std::min<std::size_t>(processes, count); ++k)
    crew.workers.push_back(start(count, counter, work));
  while (!crew.workers.empty()) {
    std::vector<pollfd> pipes;
    for (const Worker& worker : crew.workers) pipes.push_back({worker.pipe, POLLIN, 0});
    ::poll(pipes.data(), pipes.size(), -1);
    for (std::size_t k = pipes.size(); k-- > 0;) {
      if (pipes[k].revents == 0 || read_some(crew.workers[k], take)) continue;
      const Worker ended = crew.workers[k];
      crew.workers.erase(crew.workers.begin() + std::ptrdiff_t(k));
      if (!end_of(ended)) return false;
    }
  }
  return true;
}

}  // namespace mortise
