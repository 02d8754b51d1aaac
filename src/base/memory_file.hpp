// A file without a disk, for libraries that only take paths.
#pragma once

#include <string>

namespace mortise {

/// A file that lives in memory as long as this object, with a path that this process can open.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text = {});
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const;
  int descriptor() const { return descriptor_; }
  /// Its present contents.
  std::string text() const;

 private:
  int descriptor_;
};

}  // namespace mortise
