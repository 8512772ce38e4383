#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "recordings/log/byte_source.hpp"
#include "recordings/log/held_servos.hpp"
#include "recordings/log/parser.hpp"
#include "recordings/log/row.hpp"
#include "recordings/recording.hpp"

namespace touchdown::recordings {

/// Reads Upkie's logs (`.mpack`, all versions so far) row by row, live or from a file, with
/// constant memory. It skips and reports in `warnings()`
/// - records that lack needed keys, such as those of a starting spine (a number of a servo that is
///   missing now and then is held from an earlier record: recordings/log/held_servos.hpp),
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
  LogReader(ByteSource source, std::string name);

  /// The name of the file, or the name given.
  const std::string& name() const { return name_; }

  /// The next row, or nothing at the end of the log.
  std::optional<LogRow> next();

  /// The content of `config.touchdown`. For a robot's log only the control period: the typical step
  /// of the first 200 rows (recordings/sample_times.hpp). Errors: `InputError` for a robot's log
  /// with times that do not increase.
  const RecordingInfo& info();

  /// The log's clock at time 0 (s). It is 0 for a log of touchdown, and before the first row.
  double start_time() const { return start_time_.value_or(0.0); }

  /// Bytes of the record of the row that `next()` returned last, and of the records skipped right
  /// before it (or before the end). Valid until the next call of `next()`.
  std::string_view record() const { return current_.record; }
  std::string_view skipped() const { return current_.skipped; }

  /// One line per problem that was not fatal. Complete at the end of the log.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Entry {
    std::optional<LogRow> row;
    std::string record;
    std::string skipped;
  };

  void read_entry(Entry& entry);
  bool parse_record();
  bool refill();
  std::int64_t period_us_of(const std::vector<double>& times) const;
  void compare_clock_with_period(double time);
  void look_ahead(std::size_t rows);
  bool is_without_time(const LogRow& row);
  bool repeats_last();
  bool is_completed(LogValues& values, LogPresence& present);
  void count_malformed();
  [[noreturn]] void complain_about_garbage(std::size_t offset) const;
  [[noreturn]] void complain_about_missing_keys() const;
  [[noreturn]] void complain_about_unit(double step, const std::string& unit) const;
  void finish();

  ByteSource source_;
  std::string name_;
  LogParser parser_;
  std::string buffer_;
  std::size_t begin_ = 0;        ///< offset of the bytes not parsed yet, in the buffer
  std::size_t end_ = 0;          ///< offset behind the bytes read
  std::size_t record_size_ = 0;  ///< of the record parsed last
  std::uint64_t offset_ = 0;     ///< of `begin_` in the log
  std::uint64_t record_count_ = 0;
  std::uint64_t skipped_count_ = 0;
  std::uint64_t skipped_in_a_row_ = 0;
  std::uint64_t timeless_count_ = 0;
  std::string first_timeless_;  ///< position of the record
  std::uint64_t malformed_count_ = 0;
  std::string first_malformed_;  ///< position of the record and its errors
  HeldServos held_servos_;
  std::uint64_t repeated_count_ = 0;
  LogValues last_values_{};  ///< of the last row, without its wall time
  bool has_rows_ = false;
  bool at_end_ = false;
  bool has_finished_ = false;
  std::optional<double> start_time_;
  std::optional<RecordingInfo> info_;
  std::string robot_;  ///< of a robot's log
  bool has_period_ = false;
  std::vector<double> first_times_;  ///< of a log that states its period
  std::deque<Entry> ahead_;
  Entry current_;
  std::vector<std::string> warnings_;
};

}  // namespace touchdown::recordings
