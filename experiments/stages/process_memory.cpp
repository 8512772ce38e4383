#include "experiments/stages/process_memory.hpp"

#include <fstream>
#include <malloc.h>
#include <sstream>
#include <string>
#include <string_view>

namespace touchdown::experiments {

namespace {

/// A line of /proc/self/status, "VmHWM:    1234 kB".
double status_bytes(std::string_view name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(name)) continue;
    double kilobytes = 0.0;
    std::istringstream(line.substr(name.size())) >> kilobytes;
    return 1024.0 * kilobytes;
  }
  return 0.0;
}

}  // namespace

double memory_in_use() { return status_bytes("VmRSS:"); }

double peak_memory() { return status_bytes("VmHWM:"); }

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";  // proc(5): the peak becomes what is in use
}

void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace touchdown::experiments
