#include "logs/mapping/conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/stop.hpp"
#include "logs/held_number.hpp"
#include "logs/log/writer.hpp"
#include "logs/mapping/row_source.hpp"
#include "logs/mapping/row_values.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

namespace {

/// Completes rows in which numbers are missing, as in a table that joins topics of several rates: a
/// missing number is held from an earlier row for as long as estimators bridge a gap (20 ms). Rows
/// without any number of a joint belong to another topic; their numbers are held for the rows of
/// the joints.
class RowHold {
 public:
  explicit RowHold(const LogMapping& mapping) {
    for (const MappedSignal* signal : {&mapping.position, &mapping.velocity, &mapping.torque}) {
      add(*signal, true);
    }
    if (mapping.leg_targets) {
      add(mapping.leg_targets->position, true);
      if (mapping.leg_targets->velocity) add(*mapping.leg_targets->velocity, true);
      if (mapping.leg_targets->torque) add(*mapping.leg_targets->torque, true);
    }
    if (!mapping.clocks.empty()) return;  // the others have sources of their own (SourceJoin)
    add(mapping.orientation, false);
    add(mapping.angular_velocity, false);
    if (mapping.linear_acceleration) add(*mapping.linear_acceleration, false);
    if (mapping.proper_acceleration) add(*mapping.proper_acceleration, false);
  }

  /// Fills in missing numbers of a row, and counts what it did. `time` in seconds; without one,
  /// nothing is held. Returns whether the row has a number of a joint.
  bool complete(std::span<double> row, double time, ConvertedLog& converted) {
    bool has_joint = false;
    bool has_other = false;
    bool is_completed = false;
    double oldest = 0.0;
    for (Held& held : held_) {
      double& number = row[held.column];
      if (!std::isnan(number)) {
        (held.is_of_joint ? has_joint : has_other) = true;
        held.last = {number, std::isfinite(time) ? time : held.last.time};
        continue;
      }
      const std::optional<double> age = held.last.age(time);
      if (!age) continue;
      number = held.last.value;
      is_completed = true;
      oldest = std::max(oldest, *age);
    }
    if (!has_joint && has_other) {
      ++converted.rows_without_joints;
      return false;
    }
    if (is_completed) {
      ++converted.completed_rows;
      converted.oldest = std::max(converted.oldest, oldest);
    }
    return true;
  }

 private:
  struct Held {
    std::size_t column = 0;
    bool is_of_joint = false;
    HeldNumber last = {};
  };

  void add(const MappedSignal& signal, bool is_of_joint) {
    for (const MappedSignal::Number& number : signal.numbers) {
      if (number.column != MappedSignal::no_column) held_.push_back({number.column, is_of_joint});
    }
  }

  std::vector<Held> held_;
};

/// Builds contact intervals from the contact labels of the rows.
class IntervalBuilder {
 public:
  explicit IntervalBuilder(const LogMapping& mapping) : mapping_(mapping) {}

  /// `time` counts from the first time of the log.
  void add(double time, std::span<const double> row, const RowSource& rows) {
    if (!mapping_.contact || !std::isfinite(time)) return;
    if (time < last_) {
      throw InputError(
          fmt::format("{}: contact labels need increasing times: {} s comes after {} s",
                      rows.place(), time, last_));
    }
    const std::optional<std::array<bool, models::wheel_count>> contact = contact_in(row);
    const bool continues = open_ && contact == labels_.intervals.back().contact;
    if (open_ && !continues) end(time);
    if (contact && !continues) labels_.intervals.push_back({time, time, *contact});
    open_ = contact.has_value();
    if (rows_++ > 0 && time - last_ <= longest_period) {
      steps_time_ += time - last_;
      ++steps_;
    }
    last_ = time;
  }

  /// Ends the last interval: the last row lasts as long as the mean of the others, but for pauses.
  ContactIntervals finish() {
    if (open_) end(last_ + steps_time_ / std::max<double>(1.0, static_cast<double>(steps_)));
    return std::move(labels_);
  }

 private:
  /// Ends the open interval, or drops it if it has no duration (two rows of the same time).
  void end(double time) {
    labels_.intervals.back().end = time;
    if (labels_.intervals.back().start >= time) labels_.intervals.pop_back();
  }

  /// Empty if a number is missing.
  std::optional<std::array<bool, models::wheel_count>> contact_in(
      std::span<const double> row) const {
    std::array<bool, models::wheel_count> contact{};
    for (std::size_t wheel = 0; wheel < contact.size(); ++wheel) {
      const std::size_t i = std::min(wheel, mapping_.contact->numbers.size() - 1);
      const double number = mapping_.contact->value(row, i);
      if (std::isnan(number)) return std::nullopt;
      contact.at(wheel) = number > mapping_.contact_above;
    }
    return contact;
  }

  const LogMapping& mapping_;
  ContactIntervals labels_;
  bool open_ = false;
  double last_ = 0.0;
  std::uint64_t rows_ = 0;
  double steps_time_ = 0.0;  ///< of steps that are no pauses (s)
  std::uint64_t steps_ = 0;
};

class MappedRecords final : public RecordSource {
 public:
  MappedRecords(const std::filesystem::path& log, const std::filesystem::path& mapping,
                const MappingOptions& options)
      : RecordSource(options.stop),
        log_(log.string()),
        options_(options),
        rows_(open_rows(log, read_log_sources(mapping), notes())),
        mapping_(read_log_mapping(mapping, rows_->names())),
        present_(log_presence(mapping_)),
        hold_(mapping_),
        intervals_(mapping_) {
    rows_->select(mapping_);
    if (options_.with_bytes) writer_.emplace(stream_, present_, mapping_.robot);
  }

  bool next() override {
    while (!is_clock_checked_ && ahead_.size() < rows_for_clock && pull(record_)) {
      ahead_.push_back(record_);
    }
    if (!is_clock_checked_) check_clock();
    is_clock_checked_ = true;
    if (ahead_.empty()) {
      if (!pull(record_)) return false;
    } else {
      record_ = ahead_.front();
      ahead_.pop_front();
    }
    if (!writer_) return true;
    stream_.str({});
    writer_->write(record_.values);
    return true;
  }

  const LogValues& values() const override { return record_.values; }
  std::int64_t stamp() const override { return record_.stamp; }
  const LogPresence& present() const override { return present_; }
  std::string_view bytes() const override { return stream_.view(); }
  void read_origin(std::optional<RecordingInfo>& /*info*/, std::string& robot) const override {
    robot = mapping_.robot;
  }
  QuaternionReading quaternion_reading() const override {
    return {mapping_.is_w_last, mapping_.conventions.reference_is_z_up, mapping_.conventions.axes};
  }

  const std::string& robot() const { return mapping_.robot; }
  /// Complete at the end.
  const ConvertedLog& converted() const { return converted_; }

 private:
  struct Record {
    LogValues values{};
    std::int64_t stamp = 0;
  };
  static constexpr std::size_t rows_for_clock = 200;

  /// Converts the next row that is a record. Returns false at the end.
  bool pull(Record& record) {
    while (!is_at_end_) {
      end_if(notes().stop);
      if (!rows_->next(row_)) {
        finish();
        break;
      }
      const double given_time = mapping_.time
                                    ? mapping_.time->at(row_)
                                    : static_cast<double>(converted_.rows) * mapping_.period;
      const bool is_record = hold_.complete(row_, given_time, converted_);
      if (is_record) {
        record.values = log_values(mapping_, converted_.rows++, row_);
        record.stamp =
            mapping_.time ? mapping_.time->stamp(row_) : nanoseconds(record.values[log_slot::time]);
        count(record.values);
      }
      const double time = is_record ? record.values[log_slot::time] : given_time;
      if (options_.with_labels && (is_record || has_time_)) {
        intervals_.add(time - converted_.start, row_, *rows_);
      }
      if (is_record) return true;
    }
    return false;
  }

  /// Errors: `InputError` for a clock that counts another unit than the mapping states, or runs
  /// backwards.
  void check_clock() const {
    const double step = typical_step(first_times_).value_or(0.0);
    const std::string unit = unit_of_step(step);
    constexpr std::uint64_t few = 10;  // rows: their steps may be pauses
    UnpaddedFractions fractions;
    for (const double time : first_times_) fractions.add(time);
    if (fractions.count() > 0) {
      throw InputError(fmt::format("{}: time goes back, {}", log_, fractions.text()));
    }
    if (3 * converted_.time_reversals > 2 * (converted_.rows - 1)) {
      throw InputError(
          fmt::format("{}: times decrease from here on, at {} of {} rows: sort the rows by time",
                      first_reversal_, converted_.time_reversals, converted_.rows));
    }
    if (!unit.empty() && converted_.rows > few && mapping_.time &&
        mapping_.time->time.unit == 1.0) {
      throw InputError(
          fmt::format("{}: times look like {}: rows are {:.6g} apart; set the `unit` of "
                      "`time`",
                      log_, unit, step));
    }
    if (2 * long_steps_ > converted_.rows) {
      throw InputError(fmt::format(
          "{}: most rows come more than {} s after the one before: is time in ms, us or ns? "
          "Then set its `unit`",
          log_, longest_period));
    }
    constexpr double shortest_step = 4e-5;  // s, at 25,000 Hz
    if (converted_.rows > few && step > 0.0 && step < shortest_step) {
      throw InputError(
          fmt::format("{}: rows are {:.3g} s apart: is the `unit` of `time` smaller "
                      "than that of the log",
                      log_, step));
    }
  }

  void count(const LogValues& values) {
    const double time = values[log_slot::time];
    if (first_times_.size() < rows_for_clock) first_times_.push_back(time);
    const bool is_whole = std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
    if (!is_whole) ++converted_.incomplete_rows;
    if (!std::isfinite(time)) return;
    if (has_time_) {
      if (time < converted_.end && converted_.time_reversals++ == 0) {
        first_reversal_ = rows_->place();
      }
      if (time > converted_.end + longest_period) ++long_steps_;
    } else {
      converted_.start = time;
    }
    converted_.end = time;
    has_time_ = true;
  }

  void finish() {
    is_at_end_ = true;
    if (converted_.rows == 0) throw InputError(fmt::format("{}: holds no rows", log_));
    if (!has_time_) {
      throw InputError(fmt::format("{}: no row has a time that is a finite number", log_));
    }
    check_clock();
    if (options_.with_labels) converted_.contact = intervals_.finish();
    note_rows();
  }

  void note_rows() {
    const auto warn = [this](std::uint64_t count, const std::string& text) {
      if (count > 0) notes().warnings.push_back(fmt::format("{}: {}", log_, text));
    };
    warn(converted_.incomplete_rows,
         fmt::format("{} of {} rows lack a number, which is NaN in the log",
                     converted_.incomplete_rows, converted_.rows));
    warn(converted_.time_reversals,
         fmt::format("time goes back at {} rows", converted_.time_reversals));
    warn(converted_.completed_rows,
         fmt::format("{} of {} records hold numbers of an earlier row, for up to {:.4g} ms",
                     converted_.completed_rows, converted_.rows, 1e3 * converted_.oldest));
    warn(converted_.rows_without_joints,
         fmt::format("{} rows have no number of a joint: they are no records of their own",
                     converted_.rows_without_joints));
  }

  std::string log_;
  MappingOptions options_;
  std::unique_ptr<RowSource> rows_;
  LogMapping mapping_;
  LogPresence present_;
  RowHold hold_;
  IntervalBuilder intervals_;
  std::vector<double> row_;
  Record record_;
  std::vector<double> first_times_;
  std::deque<Record> ahead_;  ///< the first rows, while their clock is checked
  bool is_clock_checked_ = false;
  bool is_at_end_ = false;
  ConvertedLog converted_;
  std::uint64_t long_steps_ = 0;
  std::string first_reversal_;  ///< its place
  bool has_time_ = false;
  std::ostringstream stream_;  ///< the bytes of the present record
  std::optional<LogWriter> writer_;
};

}  // namespace

std::unique_ptr<RecordSource> mapped_records(const std::filesystem::path& log,
                                             const std::filesystem::path& mapping,
                                             const MappingOptions& options) {
  return std::make_unique<MappedRecords>(log, mapping, options);
}

std::vector<std::filesystem::path> files_of_log(const std::filesystem::path& log,
                                                const std::filesystem::path& mapping) {
  std::vector<std::filesystem::path> files = {log};
  if (mapping.empty()) return files;
  files.push_back(mapping);
  const LogSources sources = read_log_sources(mapping);
  const bool is_whole_folder = is_folder(log);
  const std::filesystem::path folder = is_whole_folder ? log : log.parent_path();
  if (sources.are_files()) {
    for (const std::string& file : sources.all()) files.push_back(folder / file);
  } else if (is_whole_folder) {
    for (const std::filesystem::path& entry : entries_in(log)) files.push_back(entry);
  }
  return files;
}

LogReader open_log(const std::filesystem::path& log, const std::filesystem::path& mapping,
                   const std::atomic<bool>* stop) {
  if (mapping.empty()) return LogReader(log, stop);
  return {mapped_records(log, mapping, {.stop = stop}), log.string()};
}

ConvertedLog convert_log(const std::filesystem::path& log, const std::filesystem::path& mapping,
                         std::ostream& stream, const MappingOptions& options) {
  MappedRecords records(log, mapping, options);
  LogWriter writer(stream, records.present(), records.robot());
  while (records.next()) writer.write(records.values());
  ConvertedLog converted = records.converted();
  converted.warnings = records.notes().warnings;
  return converted;
}

}  // namespace touchdown::logs
