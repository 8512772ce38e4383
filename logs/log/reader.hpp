#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <msgpack.hpp>

#include "logs/held_number.hpp"
#include "logs/log/byte_source.hpp"
#include "logs/log/row.hpp"
#include "logs/recording.hpp"

namespace touchdown::logs {

/// Reads the numbers of one record of a log without building the record in memory. Unknown keys are
/// skipped.
class LogParser : public msgpack::null_visitor {
 public:
  enum class Result {
    record,      ///< the bytes begin with a complete record
    incomplete,  ///< the record continues behind the bytes
    garbage,     ///< not a MessagePack map
  };

  LogParser();

  /// Parses the first record of `bytes`. `length` becomes its size; for garbage, the offset of the
  /// error.
  Result parse(std::string_view bytes, std::size_t& length);

  const LogValues& values() const { return values_; }
  /// A vector is present only if it has the right number of elements.
  const LogPresence& present() const { return present_; }
  bool has_config() const { return has_config_; }

  /// Dotted paths of the needed keys that the last record lacks, with the wrong value, if any:
  /// "observation.imu.orientation (3 numbers instead of 4)".
  std::vector<std::string> missing() const;
  bool is_missing_any() const { return (present_ & needed_) != needed_ || !has_time(); }
  /// Those of them with a wrong value.
  std::vector<std::string> malformed() const;

  /// \name Called by MessagePack's parser.
  /// @{
  bool visit_boolean(bool value);
  bool visit_positive_integer(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool visit_negative_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool visit_float32(float value) { return number(static_cast<double>(value)); }
  bool visit_float64(double value) { return number(value); }
  bool visit_str(const char* text, std::uint32_t size);
  bool start_array(std::uint32_t elements);
  bool start_map(std::uint32_t entries);
  bool start_map_key();
  bool end_map_key();
  bool end_map();
  void parse_error(std::size_t parsed, std::size_t offset);
  void insufficient_bytes(std::size_t parsed, std::size_t offset);
  /// @}

 private:
  /// The keys of a map in the previous record.
  struct KeySequence {
    struct Key {
      std::string name;
      int child;
    };
    std::vector<Key> keys;
    std::size_t position = 0;
  };

  bool number(double value);
  const LogKey* key_here() const;
  std::string instead(const LogKey& key) const;
  int child(int parent, std::string_view name);
  void drop_malformed();
  bool has_time() const;

  LogKeyTree tree_;
  std::vector<KeySequence> sequences_;  ///< per node of the tree
  std::vector<const LogKey*> vectors_;
  LogPresence needed_;
  LogPresence present_;
  LogPresence malformed_;
  LogPresence flags_;  ///< true or false instead of numbers
  LogPresence texts_;  ///< text instead of numbers
  std::array<std::uint16_t, log_slot::count>
      given_{};  ///< number of elements of a key, by its first slot
  LogValues values_{};
  std::vector<int> open_;  ///< the maps around the current value
  int current_ = 0;
  std::size_t element_ = 0;
  bool in_key_ = false;
  bool has_config_ = false;
  bool incomplete_ = false;
  std::size_t error_offset_ = 0;
};

/// Completes records in which a servo did not report: its numbers are held from the last record
/// that has them, for as long as estimators bridge a gap (20 ms), and are NaN afterwards. Upkie's
/// spine tolerates such failures, too.
class HeldServos {
 public:
  HeldServos();

  /// Fills in the missing numbers of servos. Returns false for a record that lacks other needed
  /// keys or most servos, and before the first whole record: nothing is held then.
  bool complete(LogValues& values, LogPresence& present);
  /// Remembers the numbers of a record that has them all.
  void remember(const LogValues& values, const LogPresence& present);

  /// Records that were completed by held numbers, the largest age of a held number (s), and records
  /// with numbers that are missing for longer.
  std::uint64_t records() const { return records_; }
  double oldest() const { return oldest_; }
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr std::size_t count = log_slot::imu_orientation - log_slot::servo;

  LogPresence needed_;
  bool is_started_ = false;
  std::array<HeldNumber, count> held_;
  std::uint64_t records_ = 0;
  std::uint64_t lost_ = 0;
  double oldest_ = 0.0;
};

/// Reads Upkie's logs (`.mpack`, all versions so far) row by row, live or from a file, with
/// constant memory. It skips and reports in `warnings()`
/// - records that lack needed keys, such as those of a starting spine (a number of a servo that is
///   missing now and then is held from an earlier record: `HeldServos`),
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
  /// of the first 200 rows (logs/sample_times.hpp). Errors: `InputError` for a robot's log
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

}  // namespace touchdown::logs
