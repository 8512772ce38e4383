#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "models/robot.hpp"

namespace touchdown::recordings {

/// A stretch of a log, [start, end), and whether the left and the right wheel touch in it.
struct ContactInterval {
  double start = 0.0;  ///< s
  double end = 0.0;    ///< s
  std::array<bool, models::wheel_count> contact = {};
};

/// What somebody says about a log's contact: stretches that do not overlap, the earliest first;
/// nothing is said about what lies between them. Times are those that `touchdown estimate` prints.
struct ContactIntervals {
  std::string file;
  std::vector<ContactInterval> intervals;

  /// The stretch that a time lies in, or null.
  const ContactInterval* at(double time) const;
};

/// Reads comma-separated values: a line of names, `start,end,contact` or `start,end,left,right` in
/// any order, then a line per stretch, 1 for contact and 0 for none. Errors: `InputError` with
/// file:line:column for what is none, ends before it starts, or overlaps with another.
ContactIntervals read_contact_intervals(const std::filesystem::path& path);

/// As such a file, `start,end,left,right`, which reads back to the same numbers.
std::string to_csv(const ContactIntervals& intervals);

/// Those of several logs, a file for each in their order, or none at all. Errors: `InputError` for
/// another number of files, and as above.
std::vector<ContactIntervals> read_contact_intervals(const std::vector<std::string>& files,
                                                     std::size_t logs);

}  // namespace touchdown::recordings
