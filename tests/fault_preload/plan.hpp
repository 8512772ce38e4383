#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <sys/types.h>

namespace touchdown::faults {

/// What the system can refuse.
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

/// What the processes of one program and its test share: a file that all of them map. The test says
/// what is to happen, the preload what did. Counted are files below `root` and standard output, for
/// standard error cannot complain of itself.
struct Plan {
  std::array<char, 256> root{};
  std::array<char, 64> only{};       ///< what their paths hold
  std::uint32_t counted = 0;         ///< a bit for each kind
  std::uint64_t nth = 0;             ///< of what is counted, from 1; 0 is none
  bool from_then_on = false;         ///< whether those after it fail too
  bool kills = false;                ///< the program is killed instead, by SIGKILL
  int error = 0;                     ///< errno of what fails
  std::int64_t disk = -1;            ///< bytes that fit onto it; less than 0 is no limit
  std::uint64_t shortest_segment = 0;  ///< allocations below it are neither counted nor refused

  std::atomic<std::uint64_t> seen{0};
  std::array<std::atomic<std::uint64_t>, kinds> of_kind{};
  std::atomic<std::int64_t> written{0};  ///< bytes
  std::atomic<std::uint64_t> refused{0};
  /// The first that were refused.
  struct Refused {
    Kind what{};
    std::array<char, 512> path{};
  };
  std::array<Refused, 8> first{};
  std::atomic<bool> has_filter{false};
  pid_t program = 0;
};

/// The environment variable that names the file.
constexpr const char* plan_variable = "TOUCHDOWN_FAULTS";

}  // namespace touchdown::faults
