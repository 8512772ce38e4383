#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "models/robot.hpp"

namespace touchdown::logs {

/// An interval [start, end) of a log in which the contact of the left and right wheel is known.
struct ContactInterval {
  double start = 0.0;  ///< s
  double end = 0.0;    ///< s
  std::array<bool, models::wheel_count> contact = {};
  /// Of labels that a program proposed: the lowest probability of this contact in any part of the
  /// interval.
  std::optional<double> sure = {};

  bool operator==(const ContactInterval&) const = default;
};

/// The time rounded to the microsecond (s): labels are compared and written so, because the
/// last digits of a log's times depend on how they were computed.
double to_microsecond(double time);

/// Contact labels of a log: intervals that do not overlap, in order of time. Contact between them
/// is unknown, for both wheels at once. Times are those that `touchdown estimate` prints.
struct ContactIntervals {
  std::string file;
  std::vector<ContactInterval> intervals;

  /// The interval that contains a time, to the microsecond, or null. The last one contains its end,
  /// too: it is often the time of the log's last step.
  const ContactInterval* at(double time) const;
};

/// Reads comma-separated values: a line of names, `start,end,contact` or `start,end,left,right` in
/// any order, perhaps with `sure`, then a line per interval, 1 for contact and 0 for none. Errors:
/// `InputError` with file:line:column for an invalid interval, and for one that overlaps with
/// another.
ContactIntervals read_contact_intervals(const std::filesystem::path& path);
/// The same for labels that a person has begun: none if the file is not there or has no interval.
ContactIntervals read_begun_intervals(const std::filesystem::path& path);

/// Formats intervals as such a file, `start,end,left,right` to the microsecond, and `sure` if one
/// has it. Reading it gives the same contact at every step.
std::string to_csv(const ContactIntervals& intervals);

/// Reads the labels of several logs: one file per log, in order, or no files. Errors: `InputError`
/// for another number of files, and as above.
std::vector<ContactIntervals> read_contact_intervals(const std::vector<std::string>& files,
                                                     std::size_t logs);

}  // namespace touchdown::logs
