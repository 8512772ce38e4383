#include "core/fingerprint.hpp"

#include <fmt/format.h>

#include "core/files.hpp"

namespace touchdown {

std::string Fingerprint::text() const { return fmt::format("{:016x}", state_); }

std::string build_fingerprint() {
  static const std::string name = Fingerprint().add(read_file("/proc/self/exe")).text();
  return name;
}

}  // namespace touchdown
