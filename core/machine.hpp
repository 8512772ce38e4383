#pragma once

#include <filesystem>
#include <string>

namespace touchdown {

/// What this process may use of its machine.
struct MachineShare {
  int processors = 1;
  double memory = 0.0;  ///< bytes
};

/// The processors by affinity and by the quotas of the process's control groups (versions 1 and 2),
/// rounded up; the machine's memory and swap, or the least limit of these groups. A batch system or
/// a container gives a process less than its machine has. `root` is the folder with `proc` and
/// `sys`.
MachineShare machine_share(const std::filesystem::path& root = "/");

/// The instructions of this processor, on which last digits depend: "x86-64-v3". Where the C
/// library is kept from using them, by its environment variable, it names that too.
std::string processor_class();

}  // namespace touchdown
