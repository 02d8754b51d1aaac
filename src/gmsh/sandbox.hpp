// What a .geo, which is a program, may do to the machine: nothing, enforced by the kernel. For a child process.
#pragma once

namespace mortise {

/// Takes what a .geo was about to do, in words that go on from "it"; does not return.
using ForbiddenBy = void (*)(const char* act);

/// From here on this process does not run programs, open files for writing, change files and folders by name, or open
/// connections: at the first attempt the kernel (seccomp) stops it before anything has happened, and `forbidden` is
/// called with what it was about to do, and at once where the kernel cannot do so. Threads, memory and all reading
/// stay.
void forbid_acts(ForbiddenBy forbidden);

/// While it lives, whatever file is opened for writing is this descriptor instead: for a file in memory that gmsh is
/// asked to write. Not for more than one opening.
class WritingInto {
 public:
  explicit WritingInto(int descriptor);
  ~WritingInto();
  WritingInto(const WritingInto&) = delete;
  WritingInto& operator=(const WritingInto&) = delete;
};

}  // namespace mortise
