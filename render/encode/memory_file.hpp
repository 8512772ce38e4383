#pragma once

#include <string>
#include <sys/mman.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::render {

/// A file without a name, in memory: gone with the process, however that ends.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("touchdown-video", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error("no memory for a video");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

}  // namespace touchdown::render
