#include "core/machine.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

constexpr double giga = 1e9;

TEST(MachineShare, IsLimitedByTheControlGroupsOfEitherVersionAndByThoseAbove) {
  struct Case {
    const char* what;
    const char* groups;  ///< /proc/self/cgroup
    std::vector<std::pair<const char*, const char*>> files;
    int processors;  ///< most
    double memory;   ///< most
  };
  for (const Case& one :
       std::vector<Case>{{"none", "0::/\n", {}, 1 << 20, 1e15},
                         {"no quota",
                          "0::/\n",
                          {{"cpu.max", "max 100000"}, {"memory.max", "max"}},
                          1 << 20,
                          1e15},
                         {"1.5 processors of version 2",
                          "0::/job\n",
                          {{"job/cpu.max", "150000 100000"}, {"job/memory.max", "3000000000"}},
                          2,
                          3.0 * giga},
                         {"a limit of the group above",
                          "0::/slice/job\n",
                          {{"slice/cpu.max", "50000 100000"}, {"slice/job/memory.max", "max"}},
                          1,
                          1e15},
                         {"version 1",
                          "4:memory:/job\n3:cpu,cpuacct:/job\n",
                          {{"cpu,cpuacct/job/cpu.cfs_quota_us", "100000"},
                           {"cpu,cpuacct/job/cpu.cfs_period_us", "100000"},
                           {"memory/job/memory.limit_in_bytes", "2000000000"}},
                          1,
                          2.0 * giga},
                         {"version 1 without a quota",
                          "3:cpu,cpuacct:/job\n",
                          {{"cpu,cpuacct/job/cpu.cfs_quota_us", "-1"},
                           {"cpu,cpuacct/job/cpu.cfs_period_us", "100000"}},
                          1 << 20,
                          1e15},
                         {"a container, with the host's path",
                          "4:memory:/docker/abc\n",
                          {{"memory/memory.limit_in_bytes", "1000000000"}},
                          1 << 20,
                          giga}}) {
    const ScratchFolder root;
    root.write("proc/self/cgroup", one.groups);
    for (const auto& [file, text] : one.files) {
      root.write(std::string("sys/fs/cgroup/") + file, text);
    }
    const ScratchFolder bare;
    const MachineShare whole = machine_share(bare.path());
    const MachineShare share = machine_share(root.path());
    EXPECT_EQ(share.processors, std::min(whole.processors, one.processors)) << one.what;
    EXPECT_EQ(share.memory, std::min(whole.memory, one.memory)) << one.what;
  }
}

TEST(ProcessorClass, NamesWhatKeepsTheCLibraryFromItsInstructions) {
  ::unsetenv("GLIBC_TUNABLES");
  const std::string plain = processor_class();
  ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2", 1);
  const std::string kept = processor_class();
  ::unsetenv("GLIBC_TUNABLES");
  EXPECT_EQ(kept, plain + " with GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2");
}

}  // namespace
}  // namespace touchdown
