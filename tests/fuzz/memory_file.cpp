#include "tests/fuzz/memory_file.hpp"

#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace touchdown::fuzz {

MemoryFile::MemoryFile(std::string_view content) : descriptor_(::memfd_create("fuzz", 0)) {
  set_content(content);
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::filesystem::path MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

void MemoryFile::set_content(std::string_view content) {
  if (::ftruncate(descriptor_, 0) != 0) std::abort();
  off_t offset = 0;
  while (!content.empty()) {
    const ssize_t size = ::pwrite(descriptor_, content.data(), content.size(), offset);
    if (size <= 0) std::abort();
    content.remove_prefix(static_cast<std::size_t>(size));
    offset += size;
  }
}

}  // namespace touchdown::fuzz
