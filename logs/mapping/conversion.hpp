#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "logs/log/contact_intervals.hpp"
#include "logs/log/row.hpp"
#include "logs/mapping/mapping.hpp"

namespace touchdown::logs {

/// The result of converting another robot's log.
struct ConvertedLog {
  std::uint64_t rows = 0;
  double start = 0.0;                     ///< first finite time (s)
  double end = 0.0;                       ///< last finite time (s)
  std::uint64_t incomplete_rows = 0;      ///< rows with an empty, NaN or infinite number
  std::uint64_t time_reversals = 0;       ///< rows with a time before that of the previous row
  std::uint64_t completed_rows = 0;       ///< rows with numbers held from an earlier row (RowHold)
  double oldest = 0.0;                    ///< largest age of a held number (s)
  std::uint64_t rows_without_joints = 0;  ///< rows of another topic, which are no records
  std::vector<std::string> notes;         ///< one line for each thing to know about the sources
  /// Contact labels, if the mapping specifies their columns. Times count from `start`.
  ContactIntervals contact;
};

/// One line for each thing that a user should know about the log of this name.
std::vector<std::string> warnings_of(const ConvertedLog& converted, const std::string& log);

/// One time step of another robot, in Upkie's conventions, from a row with the numbers of
/// `LogMapping::columns`. `k` counts the rows, for logs without a clock.
LogRow mapped_row(const LogMapping& mapping, std::uint64_t k, std::span<const double> row);

/// Converts another robot's log, CSV, NumPy's arrays or a ROS 2 bag, to a robot's log in Upkie's
/// layout, by a mapping file. `log` is the folder of the sources if the mapping has several. Each
/// row becomes one record with the measurements only. Missing values are held from an earlier row
/// or become NaN. Without `with_labels`, contact labels are not looked at. `check_stop` is called
/// regularly, and may throw. Errors: `InputError` as in `read_log_mapping`, `read_source_log` and
/// `read_joined_log`, for a log without rows or times, and for contact labels with decreasing
/// times; `Error` when the stream fails.
ConvertedLog convert_log(const std::filesystem::path& log, const std::filesystem::path& mapping,
                         std::ostream& stream, const std::function<void()>& check_stop = {},
                         bool with_labels = true);

/// Another robot's log or ROS 2 bag as a log in Upkie's layout, for programs that read such logs.
/// It is in a temporary folder, which is deleted with this object.
class MappedLog {
 public:
  /// `check_stop` is called regularly, and may throw. Errors: those of `convert_log`; `Error` if
  /// the disk is full.
  MappedLog(const std::filesystem::path& log, const std::filesystem::path& mapping,
            const std::function<void()>& check_stop = {});

  std::filesystem::path path() const { return folder_.path() / "log.mpack"; }
  /// One line for each thing that a user should know.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  PartFolder folder_;
  std::vector<std::string> warnings_;
};

}  // namespace touchdown::logs
