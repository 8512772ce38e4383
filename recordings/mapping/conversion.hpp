#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>

#include "recordings/beliefs/contact_intervals.hpp"

namespace touchdown::recordings {

/// What became of a foreign log.
struct ConvertedLog {
  std::uint64_t rows = 0;
  double start = 0.0;         ///< its first time that is a finite number (s)
  double end = 0.0;           ///< its last one
  std::uint64_t lacking = 0;  ///< rows with a number that is missing: empty, NaN or infinite
  std::uint64_t back = 0;     ///< rows whose time lies before the one of the row before
  /// What the log says about contact, if the mapping says where; times count from `start`.
  ContactIntervals contact;
};

/// Writes somebody else's log, CSV or NumPy's arrays, as a robot's log in Upkie's layout, as the
/// mapping file says: a record for each row, with what was measured and nothing else. What is
/// missing is NaN there. `check_stop` is called now and then, and may throw. Errors: `InputError`
/// as `read_log_mapping` and `read_source_log`, for a log without rows or times, and for labels of
/// contact whose time goes back; `Error` when the stream fails.
ConvertedLog convert_log(const std::filesystem::path& log, const std::filesystem::path& mapping,
                         std::ostream& stream, const std::function<void()>& check_stop = {});

}  // namespace touchdown::recordings
