#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "recordings/log/byte_source.hpp"
#include "recordings/log/parser.hpp"
#include "recordings/log/row.hpp"
#include "recordings/recording.hpp"

namespace touchdown::recordings {

/// Reads Upkie's logs (`.mpack`, any version so far) row by row, live or from a file, at a constant
/// memory. Records that lack needed keys, as a spine writes while it starts, are skipped, and so
/// are those with something else than its numbers at one (reported by `warnings()`), and records
/// before the first row whose time is not finite; a last record that is cut off is reported by
/// `warnings()`. In a log that we did not write, time counts from the first row. Errors
/// (`InputError`): a file that cannot be read; bytes that are no MessagePack maps (named by their
/// offset); a log whose records all lack a needed key (all of them named in one message).
class LogReader {
 public:
  /// "-" reads standard input. The log ends early once `stop`, which may be null, is true.
  explicit LogReader(const std::filesystem::path& path, const std::atomic<bool>* stop = nullptr);
  /// `name` stands in messages.
  LogReader(ByteSource source, std::string name);

  /// The file's, or the one that was given.
  const std::string& name() const { return name_; }

  /// The next row, or nothing at the end of the log.
  std::optional<LogRow> next();

  /// What `config.touchdown` says, or for a robot's log nothing but the control period, the median
  /// difference of time in the first rows.
  const RecordingInfo& info();

  /// What the log's clock said at its time 0 (s): 0 for a log of ours, and before the first row.
  double start_time() const { return start_time_.value_or(0.0); }

  /// Bytes of the record behind the row that `next()` gave last, and of the records that were
  /// skipped right before it (or before the end); valid until `next()` is called again.
  std::string_view record() const { return current_.record; }
  std::string_view skipped() const { return current_.skipped; }

  /// One line each about what was wrong but not fatal; complete at the end of the log.
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
  void look_ahead(std::size_t rows);
  bool is_without_time(const LogRow& row);
  void count_malformed();
  [[noreturn]] void complain_about_garbage(std::size_t offset) const;
  [[noreturn]] void complain_about_missing_keys() const;
  void finish();

  ByteSource source_;
  std::string name_;
  LogParser parser_;
  std::string buffer_;
  std::size_t begin_ = 0;        ///< of what is not parsed yet, in the buffer
  std::size_t end_ = 0;          ///< of what was read
  std::size_t record_size_ = 0;  ///< of the record that was parsed last
  std::uint64_t offset_ = 0;     ///< of `begin_` in the log
  std::uint64_t record_count_ = 0;
  std::uint64_t skipped_count_ = 0;
  std::uint64_t skipped_in_a_row_ = 0;
  std::uint64_t timeless_count_ = 0;
  std::string first_timeless_;  ///< where that record is
  std::uint64_t malformed_count_ = 0;
  std::string first_malformed_;  ///< where that record is, and what is wrong with it
  bool has_rows_ = false;
  bool at_end_ = false;
  bool has_finished_ = false;
  std::optional<double> start_time_;
  std::optional<RecordingInfo> info_;
  bool has_period_ = false;
  std::deque<Entry> ahead_;
  Entry current_;
  std::vector<std::string> warnings_;
};

}  // namespace touchdown::recordings
