#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <sys/types.h>

namespace touchdown::faults {

/// Kinds of calls that can be made to fail.
enum class Kind : std::uint8_t {
  read,
  write,
  open,
  rename,
  flush,
  folder,
  link,
  resize,
  allocation
};
constexpr std::size_t kinds = 9;
constexpr std::array<const char*, kinds> kind_names = {
    "read", "write", "open", "rename", "flush", "folder", "link", "resize", "allocation"};

/// Shared by a test and the processes of one program, as a mapped file. The test specifies the
/// faults, the preload reports them. Calls on files below `root` and on standard output are
/// counted. Standard error is not: its faults cannot be reported.
struct Plan {
  std::array<char, 256> root{};
  std::array<char, 64> only{};            ///< counted paths contain this text
  std::uint32_t counted = 0;              ///< kinds that are counted, one bit each
  std::uint64_t nth = 0;                  ///< counted call that fails, from 1; 0: none
  bool from_then_on = false;              ///< whether later calls fail too
  bool kills = false;                     ///< instead, the program is killed by SIGKILL
  int error = 0;                          ///< errno of failing calls
  std::int64_t disk = -1;                 ///< capacity (bytes); negative: no limit
  std::uint64_t smallest_allocation = 0;  ///< smaller ones (bytes) are neither counted nor refused

  std::atomic<std::uint64_t> seen{0};  ///< counted calls so far
  std::array<std::atomic<std::uint64_t>, kinds> of_kind{};
  std::atomic<std::int64_t> written{0};  ///< bytes
  std::atomic<std::uint64_t> refused{0};
  /// A refused call.
  struct Refused {
    Kind what{};
    std::array<char, 512> path{};
  };
  std::array<Refused, 8> first{};
  std::atomic<bool> has_filter{false};
  pid_t program = 0;
};

/// The environment variable with the path of the mapped file.
constexpr const char* plan_variable = "TOUCHDOWN_FAULTS";

}  // namespace touchdown::faults
