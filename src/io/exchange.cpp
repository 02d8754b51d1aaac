#include "io/exchange.hpp"

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace mortise {

namespace fs = std::filesystem;

fs::path aside_of(const fs::path& a) {
  fs::path aside = a;
  aside += "-old";
  return aside;
}

void exchange_folders_in_steps(const fs::path& a, const fs::path& b, const fs::path& aside) {
  fs::rename(b, aside);
  try {
    fs::rename(a, b);
  } catch (const fs::filesystem_error&) {
    fs::rename(aside, b);
    throw;
  }
  fs::rename(aside, a);
}

void exchange_folders(const fs::path& a, const fs::path& b) {
  if (syscall(SYS_renameat2, AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return;
  // NFS and some FUSE file systems know no exchange.
  if (errno == EINVAL || errno == ENOSYS || errno == ENOTSUP) {
    exchange_folders_in_steps(a, b, aside_of(a));
    return;
  }
  throw fs::filesystem_error("cannot exchange", a, b, std::error_code(errno, std::generic_category()));
}

}  // namespace mortise
