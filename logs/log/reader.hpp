#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "logs/log/byte_source.hpp"
#include "logs/log/record_source.hpp"
#include "logs/log/row.hpp"
#include "logs/recording.hpp"

namespace touchdown::logs {

/// Reads Upkie's logs (`.mpack`, all versions so far), or other records, row by row, live or from a
/// file, with constant memory. It skips and reports in `warnings()`
/// - records that lack needed keys, such as those of a starting spine (a number of a servo that is
///   missing now and then is held from an earlier record, for as long as estimators bridge a gap),
/// - records with another type of value at a needed key,
/// - records without a finite time before the first row,
/// - records that repeat the one before with its time and all its numbers,
/// - and a last record that is cut off.
/// The time of a robot's log counts from its first row. Errors (`InputError`): a file that cannot
/// be read; bytes that are not MessagePack maps (named by their offset); a log without a single
/// complete record (all missing keys named in one message); a log that states its period, with
/// times in milliseconds, microseconds or nanoseconds.
class LogReader {
 public:
  /// "-" reads standard input. The log ends early once `stop` is true; `stop` may be null.
  explicit LogReader(const std::filesystem::path& path, const std::atomic<bool>* stop = nullptr);
  /// `name` is used in messages.
  LogReader(ByteSource source, const std::string& name);
  LogReader(std::unique_ptr<RecordSource> records, std::string name);
  LogReader(LogReader&& other) noexcept;
  ~LogReader();

  /// The name of the file, or the name given.
  const std::string& name() const { return name_; }

  /// The next row, or nothing at the end of the log.
  std::optional<LogRow> next();

  /// The content of `config.touchdown`. For a robot's log only the control period: the typical step
  /// of the first 200 rows (logs/sample_times.hpp). Errors: `InputError` for a robot's log
  /// with times that do not increase.
  const RecordingInfo& info();

  /// The log's clock at time 0 (s). It is 0 for a log of touchdown, and before the first row.
  double start_time() const { return start_time_.value_or(0.0); }

  /// The log's clock at the row that `next()` returned last (ns).
  std::int64_t stamp() const { return current_.stamp; }

  /// Bytes of the record of the row that `next()` returned last, and of the records skipped right
  /// before it (or before the end). Valid until the next call of `next()`.
  std::string_view record() const { return current_.record; }
  std::string_view skipped() const { return current_.skipped; }

  QuaternionReading quaternion_reading() const { return records_->quaternion_reading(); }

  /// Of the log and its source; callers may add to them.
  LogNotes& notes() { return records_->notes(); }
  /// One line per problem that was not fatal: those of the notes, then of the records' values.
  /// Complete at the end of the log.
  std::vector<std::string> warnings() const;

 private:
  class Cleaning;
  struct Entry {
    std::optional<LogRow> row;
    std::int64_t stamp = 0;
    std::string record;
    std::string skipped;
  };

  void read_entry(Entry& entry);
  std::int64_t period_us_of(const std::vector<double>& times) const;
  void compare_clock_with_period(double time);
  void look_ahead(std::size_t rows);
  [[noreturn]] void complain_about_unit(double step, const std::string& unit) const;

  std::unique_ptr<RecordSource> records_;
  std::string name_;
  std::unique_ptr<Cleaning> cleaning_;
  std::optional<double> start_time_;
  std::optional<RecordingInfo> info_;
  std::string robot_;  ///< of a robot's log
  bool has_period_ = false;
  std::vector<double> first_times_;  ///< of a log that states its period
  std::deque<Entry> ahead_;
  Entry current_;
};

}  // namespace touchdown::logs
