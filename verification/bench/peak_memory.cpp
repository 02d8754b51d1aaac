#include "peak_memory.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace mortise::bench {

double peak_megabytes(const std::function<void()>& prepare, const std::function<void()>& work) {
  malloc_trim(0);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("pipe failed");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    int status = 1;
    try {
      prepare();
      malloc_trim(0);
      std::ofstream("/proc/self/clear_refs") << "5";  // forget the peak so far (man 5 proc)
      work();
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      status = write(ends[1], &usage.ru_maxrss, sizeof usage.ru_maxrss) == sizeof usage.ru_maxrss ? 0 : 1;
    } catch (...) {
    }
    _exit(status);
  }
  close(ends[1]);
  long kilobytes = 0;
  const bool read_all = read(ends[0], &kilobytes, sizeof kilobytes) == sizeof kilobytes;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!read_all || status != 0) throw std::runtime_error("the child that measures memory failed");
  return double(kilobytes) / 1024;
}

}  // namespace mortise::bench
