#include "core/machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sched.h>
#include <sys/sysinfo.h>
#include <thread>

#include <fmt/format.h>

namespace touchdown {

namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The numbers at the beginning of a file; unlimited for "max", and without the file.
std::array<double, 2> numbers_in(const fs::path& file) {
  std::array<double, 2> numbers = {unlimited, unlimited};
  std::ifstream stream(file);
  std::string word;
  for (double& number : numbers) {
    if (!(stream >> word)) break;
    if (word != "max") number = std::strtod(word.c_str(), nullptr);
  }
  return numbers;
}

/// What a control group grants: processors by the CPU time of a period, memory in bytes. Version 1
/// writes −1 for no quota.
MachineShare grants(const fs::path& group) {
  const auto [quota, period] = numbers_in(group / "cpu.max");
  const double quota_1 = numbers_in(group / "cpu.cfs_quota_us")[0];
  const double period_1 = numbers_in(group / "cpu.cfs_period_us")[0];
  double processors = quota / (std::isfinite(period) ? period : 1.0);
  if (quota_1 > 0.0 && std::isfinite(quota_1))
    processors = std::min(processors, quota_1 / period_1);
  constexpr double most = 1e6;
  return {static_cast<int>(std::ceil(std::isfinite(processors) ? processors : most)),
          std::min(numbers_in(group / "memory.max")[0],
                   numbers_in(group / "memory.limit_in_bytes")[0])};
}

int processors_by_affinity() {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof(allowed), &allowed) == 0) return CPU_COUNT(&allowed);
  return static_cast<int>(std::thread::hardware_concurrency());  // more than a set holds
}

}  // namespace

MachineShare machine_share(const fs::path& root) {
  struct sysinfo machine = {};
  MachineShare share{processors_by_affinity(), unlimited};
  if (::sysinfo(&machine) == 0) {
    share.memory = static_cast<double>(machine.totalram + machine.totalswap) * machine.mem_unit;
  }
  // Lines are "number:controllers:path"; version 2 names no controllers. In a container the path
  // may be the host's: its folders are missing there, and the container's limits stand at the top.
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const fs::path top = root / "sys/fs/cgroup" / line.substr(first + 1, second - first - 1);
    for (fs::path below = line.substr(second + 1);; below = below.parent_path()) {
      const MachineShare granted = grants(top / below.relative_path());
      share.processors = std::min(share.processors, granted.processors);
      share.memory = std::min(share.memory, granted.memory);
      if (below == below.parent_path()) break;
    }
  }
  share.processors = std::max(share.processors, 1);
  return share;
}

std::string processor_class() {
  std::string name = "other";
#if defined(__x86_64__)
  name = __builtin_cpu_supports("avx512vl") ? "x86-64-v4"
         : __builtin_cpu_supports("avx2")   ? "x86-64-v3"
                                            : "x86-64";
#elif defined(__aarch64__)
  name = "aarch64";
#endif
  const char* const tunables = std::getenv("GLIBC_TUNABLES");
  if (tunables == nullptr) return name;
  return fmt::format("{} with GLIBC_TUNABLES={}", name, tunables);
}

}  // namespace touchdown
