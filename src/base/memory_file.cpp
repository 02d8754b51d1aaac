#include "base/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace mortise {

MemoryFile::MemoryFile(const std::string& text) : descriptor_(memfd_create("mortise", MFD_CLOEXEC)) {
  if (descriptor_ < 0) throw std::runtime_error("memfd_create failed");
  if (::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    ::close(descriptor_);
    throw std::runtime_error("writing to a memory file failed");
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

std::string MemoryFile::text() const {
  std::string all;
  std::array<char, 65536> part;
  ssize_t count = 0;
  while ((count = ::pread(descriptor_, part.data(), part.size(), static_cast<off_t>(all.size()))) > 0)
    all.append(part.data(), static_cast<std::size_t>(count));
  if (count < 0) throw std::runtime_error("reading a memory file failed");
  return all;
}

}  // namespace mortise
