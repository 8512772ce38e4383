#include "core/program/memory.hpp"

#include <malloc.h>

namespace touchdown {

void keep_freed_memory() noexcept {
  constexpr int gigabyte = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, gigabyte);
  ::mallopt(M_TRIM_THRESHOLD, gigabyte);
}

void release_free_memory() noexcept {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace touchdown
