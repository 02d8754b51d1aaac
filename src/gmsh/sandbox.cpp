#include "gmsh/sandbox.hpp"

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <new>

namespace mortise {
namespace {

ForbiddenBy forbidden_by = nullptr;
int writing_into = -1;

constexpr std::array programs{SCMP_SYS(execve), SCMP_SYS(execveat), SCMP_SYS(fork),
                              SCMP_SYS(vfork),  SCMP_SYS(ptrace),   SCMP_SYS(process_vm_writev),
                              SCMP_SYS(kill),   SCMP_SYS(tkill),    SCMP_SYS(pidfd_open)};
constexpr std::array connections{SCMP_SYS(socket), SCMP_SYS(socketpair), SCMP_SYS(connect), SCMP_SYS(bind)};
constexpr std::array changes{
    SCMP_SYS(creat),    SCMP_SYS(truncate),  SCMP_SYS(mkdir),       SCMP_SYS(mkdirat),   SCMP_SYS(rmdir),
    SCMP_SYS(unlink),   SCMP_SYS(unlinkat),  SCMP_SYS(rename),      SCMP_SYS(renameat),  SCMP_SYS(renameat2),
    SCMP_SYS(link),     SCMP_SYS(linkat),    SCMP_SYS(symlink),     SCMP_SYS(symlinkat), SCMP_SYS(mknod),
    SCMP_SYS(mknodat),  SCMP_SYS(chmod),     SCMP_SYS(fchmodat),    SCMP_SYS(chown),     SCMP_SYS(lchown),
    SCMP_SYS(fchownat), SCMP_SYS(utime),     SCMP_SYS(utimes),      SCMP_SYS(utimensat), SCMP_SYS(futimesat),
    SCMP_SYS(setxattr), SCMP_SYS(lsetxattr), SCMP_SYS(removexattr), SCMP_SYS(mount),     SCMP_SYS(umount2)};

bool is_one_of(const auto& calls, int number) {
  for (const int call : calls)
    if (call == number) return true;
  return false;
}

/// Makes the system call that was stopped return this.
void return_from_call(void* context, int value) {
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
  registers.gregs[REG_RAX] = value;
#elif defined(__aarch64__)
  registers.regs[0] = static_cast<unsigned long long>(value);
#else
  static_cast<void>(registers);
  forbidden_by("wrote a file");
#endif
}

void on_forbidden(int /*signal*/, siginfo_t* info, void* context) {
  const int call = info->si_syscall;
  const bool opens = call == SCMP_SYS(openat) || call == SCMP_SYS(open) || call == SCMP_SYS(creat);
  if (opens && writing_into >= 0) {
    return_from_call(context, writing_into);
    writing_into = -1;
    return;
  }
  if (is_one_of(connections, call)) forbidden_by("opens a connection");
  if (is_one_of(changes, call) || opens) forbidden_by("writes a file or changes a folder");
  forbidden_by("runs a program");
}

class Filter {
 public:
  Filter() : filter_(seccomp_init(SCMP_ACT_ALLOW)) {
    if (!filter_) throw std::bad_alloc();
  }
  ~Filter() { seccomp_release(filter_); }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  void stop(int call) { require(seccomp_rule_add(filter_, SCMP_ACT_TRAP, call, 0)); }
  void stop(int call, const scmp_arg_cmp& where) { require(seccomp_rule_add(filter_, SCMP_ACT_TRAP, call, 1, where)); }
  void lacks(int call) { require(seccomp_rule_add(filter_, SCMP_ACT_ERRNO(ENOSYS), call, 0)); }
  void load() { require(seccomp_load(filter_)); }

 private:
  // A call that this processor does not have (-EDOM) need not be stopped.
  static void require(int error) {
    if (error != 0 && error != -EDOM)
      forbidden_by("may run programs, as this kernel has no seccomp to keep it from that");
  }
  scmp_filter_ctx filter_;
};

/// Opening for anything but reading, by the flags in that argument.
void stop_writing(Filter& filter, int call, unsigned flags) {
  for (const int flag : {O_WRONLY, O_RDWR, O_CREAT, O_TRUNC}) {
    const auto bits = static_cast<scmp_datum_t>(flag);
    filter.stop(call, SCMP_CMP(flags, SCMP_CMP_MASKED_EQ, bits, bits));
  }
}

}  // namespace

void forbid_acts(ForbiddenBy forbidden) {
  forbidden_by = forbidden;
  struct sigaction action {};
  action.sa_sigaction = on_forbidden;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  ::sigaction(SIGSYS, &action, nullptr);

  Filter filter;
  for (const int call : programs) filter.stop(call);
  for (const int call : connections) filter.stop(call);
  for (const int call : changes) filter.stop(call);
  stop_writing(filter, SCMP_SYS(open), 1);
  stop_writing(filter, SCMP_SYS(openat), 2);
  // A new thread is none of a program's; clone3 and openat2 hide their flags, and without them the others are used.
  filter.stop(SCMP_SYS(clone), SCMP_CMP(0, SCMP_CMP_MASKED_EQ, static_cast<scmp_datum_t>(CLONE_THREAD), 0));
  for (const int call : {SCMP_SYS(clone3), SCMP_SYS(openat2), SCMP_SYS(io_uring_setup)}) filter.lacks(call);
  filter.load();
}

WritingInto::WritingInto(int descriptor) { writing_into = ::dup(descriptor); }

WritingInto::~WritingInto() {
  if (writing_into >= 0) ::close(writing_into);
  writing_into = -1;
}

}  // namespace mortise
