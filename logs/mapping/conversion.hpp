#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "logs/log/contact_intervals.hpp"
#include "logs/log/reader.hpp"
#include "logs/log/record_source.hpp"

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
  std::vector<std::string> warnings;      ///< as those of `LogNotes`
  /// Contact labels, if the mapping specifies their columns. Times count from `start`.
  ContactIntervals contact;
};

/// How a log is converted.
struct MappingOptions {
  const std::atomic<bool>* stop = nullptr;  ///< once true, reading ends with `Stopped`
  bool with_bytes = false;                  ///< the records have bytes, for programs that copy them
  bool with_labels = false;                 ///< contact labels are looked at
};

/// Another robot's log, CSV, NumPy's arrays or a ROS 2 bag, as records in Upkie's layout by a
/// mapping file, pulled row by row. `log` is the folder of the sources if the mapping has several.
/// Each row becomes one record with the measurements only. Missing values are held from an earlier
/// row or become NaN. Errors: `InputError` as in `read_log_mapping` and `open_rows`, for a log
/// without rows or times, and for a clock that counts another unit, which the first 200 rows show.
std::unique_ptr<RecordSource> mapped_records(const std::filesystem::path& log,
                                             const std::filesystem::path& mapping,
                                             const MappingOptions& options = {});

/// The files that a log is read from, which an output must not replace: those of the mapping's
/// sources, and those of a bag. `mapping` may be empty. Errors: those of the mapping.
std::vector<std::filesystem::path> files_of_log(const std::filesystem::path& log,
                                                const std::filesystem::path& mapping);

/// Opens a log in Upkie's layout, or another robot's by a mapping file; `mapping` may be empty. A
/// log in Upkie's layout ends early once `stop` is true.
LogReader open_log(const std::filesystem::path& log, const std::filesystem::path& mapping,
                   const std::atomic<bool>* stop);

/// Writes such records as a log in Upkie's layout. Errors: as above; `InputError` for contact
/// labels with decreasing times; `Error` when the stream fails.
ConvertedLog convert_log(const std::filesystem::path& log, const std::filesystem::path& mapping,
                         std::ostream& stream, const MappingOptions& options = {});

}  // namespace touchdown::logs
