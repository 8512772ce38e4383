#include "logs/log/reader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "logs/held_number.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

namespace {

/// Until all of its observers run, a spine logs incomplete records; two seconds are too long.
constexpr std::uint64_t most_skipped_in_a_row = 2000;
constexpr std::size_t rows_for_period = 200;
/// With fewer rows, long steps may be pauses.
constexpr std::size_t rows_for_unit = 11;
/// Beyond any clock in any unit: nanoseconds since 1970 are 2e18.
constexpr double largest_time = 1e20;

bool has_time(const LogPresence& present) {
  return present[log_slot::time] || present[log_slot::wall_time];
}

LogPresence needed_values() {
  LogPresence needed;
  for (const LogKey& key : log_keys()) {
    if (key.role != LogKey::Role::needed) continue;
    for (std::size_t i = 0; i < key.size; ++i) needed.set(key.slot + i);
  }
  return needed;
}

}  // namespace

/// Completes records in which a servo did not report: its numbers are held from the last record
/// that has them, for as long as estimators bridge a gap (20 ms), and are NaN afterwards. Upkie's
/// spine tolerates such failures, too.
class HeldServos {
 public:
  /// Fills in the missing numbers of servos. Returns false for a record that lacks other needed
  /// keys or most servos, and before the first whole record: nothing is held then.
  bool complete(LogValues& values, LogPresence& present) {
    if (!is_started_ || !has_time(present)) return false;
    const LogPresence missing = needed_ & ~present;
    std::size_t of_servos = 0;
    for (std::size_t i = 0; i < count; ++i) of_servos += missing[log_slot::servo + i] ? 1 : 0;
    if (of_servos != missing.count() || 2 * of_servos > count) return false;
    const double now = time_of(values, present);
    double oldest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t slot = log_slot::servo + i;
      if (!missing[slot]) {
        held_[i] = {values[slot], now};
        continue;
      }
      const std::optional<double> age = held_[i].age(now);
      values[slot] = age ? held_[i].value : std::numeric_limits<double>::quiet_NaN();
      present.set(slot);
      oldest = age ? std::max(oldest, *age) : std::numeric_limits<double>::infinity();
    }
    if (oldest > longest_hold) {
      ++lost_;
    } else {
      ++records_;
      oldest_ = std::max(oldest_, oldest);
    }
    return true;
  }

  /// Remembers the numbers of a record that has them all.
  void remember(const LogValues& values, const LogPresence& present) {
    is_started_ = true;
    const double now = time_of(values, present);
    for (std::size_t i = 0; i < count; ++i) held_[i] = {values[log_slot::servo + i], now};
  }

  /// Records that were completed by held numbers, the largest age of a held number (s), and records
  /// with numbers that are missing for longer.
  std::uint64_t records() const { return records_; }
  double oldest() const { return oldest_; }
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr std::size_t count = log_slot::imu_orientation - log_slot::servo;

  LogPresence needed_ = needed_values();
  bool is_started_ = false;
  std::array<HeldNumber, count> held_;
  std::uint64_t records_ = 0;
  std::uint64_t lost_ = 0;
  double oldest_ = 0.0;
};

/// What is done to the values of a log's records: some are left out, and what servos did not report
/// is held. It counts both.
class LogReader::Cleaning {
 public:
  explicit Cleaning(std::string name) : name_(std::move(name)) {}

  /// The row of the present record; nothing for one that is left out.
  std::optional<LogRow> row_of(const RecordSource& records) {
    ++records_;
    LogValues values = records.values();
    LogPresence present = records.present();
    if (!has_all_values(records, values, present)) {
      ++skipped_;
      count_skipped(records);
      return std::nullopt;
    }
    if (repeats_last(records)) return std::nullopt;
    LogRow row = to_row(values, present);
    double& time = row.observation.time;
    if (!(std::abs(time) <= largest_time)) time = std::numeric_limits<double>::quiet_NaN();
    if (is_without_time(records, time)) {
      count_skipped(records);
      return std::nullopt;
    }
    skipped_in_a_row_ = 0;
    has_rows_ = true;
    return row;
  }

  /// Errors: `InputError` for a log without rows, but a simulated run may end before its first
  /// step.
  void finish(const RecordSource& records, bool may_be_empty) const {
    if (!has_rows_ && !may_be_empty) complain_about_missing_keys(records);
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> warnings;
    const auto warn = [&](std::uint64_t count, const std::string& text) {
      if (count > 0 && has_rows_) warnings.push_back(fmt::format("{}: {}", name_, text));
    };
    warn(skipped_,
         fmt::format("{} of {} records lack needed keys and were left out", skipped_, records_));
    warn(malformed_, malformed_ == 1
                         ? first_malformed_
                         : fmt::format("{}; {} more like it", first_malformed_, malformed_ - 1));
    warn(timeless_,
         fmt::format("{} is not a finite number: it was left out{}", first_timeless_,
                     timeless_ == 1 ? ""
                                    : fmt::format(", and {} more before the first good record",
                                                  timeless_ - 1)));
    warn(held_servos_.records(),
         fmt::format("{} of {} records lack numbers of servos: they are held from the record "
                     "before, for up to {:.4g} ms{}",
                     held_servos_.records(), records_, 1e3 * held_servos_.oldest(),
                     held_servos_.lost() == 0
                         ? ""
                         : fmt::format("; {} records lack them for longer", held_servos_.lost())));
    warn(held_servos_.records() == 0 ? held_servos_.lost() : 0,
         fmt::format("{} of {} records lack numbers of servos for longer than {:.4g} ms",
                     held_servos_.lost(), records_, 1e3 * longest_hold));
    warn(repeated_, fmt::format("{} of {} records repeat the one before, with its time and all its "
                                "numbers, and were left out",
                                repeated_, records_));
    return warnings;
  }

 private:
  /// Whether a record has all values that are needed, or those that it lacks are held from an
  /// earlier one. A value of another type is no missing one.
  bool has_all_values(const RecordSource& records, LogValues& values, LogPresence& present) {
    if ((present & needed_) == needed_ && has_time(present)) {
      held_servos_.remember(values, present);
      return true;
    }
    std::vector<std::string> malformed = records.missing();
    std::erase_if(malformed, [](const std::string& path) { return !path.ends_with(')'); });
    if (malformed.empty()) return held_servos_.complete(values, present);
    if (++malformed_ == 1) {
      first_malformed_ =
          fmt::format("{}record {} has {}", records.place(), records_, fmt::join(malformed, ", "));
    }
    return false;
  }

  /// Applies before the first row only, which defines time zero. Later the guard of an estimator
  /// checks the time.
  bool is_without_time(const RecordSource& records, double time) {
    if (has_rows_ || std::isfinite(time)) return false;
    if (++timeless_ == 1) {
      first_timeless_ = fmt::format("{}the time of record {}", records.place(), records_);
    }
    return true;
  }

  /// Whether the record has the time and all numbers of the last row: it was written twice.
  bool repeats_last(const RecordSource& records) {
    LogValues values = records.values();
    if (records.present()[log_slot::time]) values[log_slot::wall_time] = 0.0;
    // By bits, because missing commands are NaN.
    const auto is_same = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    if (has_rows_ && std::equal(values.begin(), values.end(), last_values_.begin(), is_same)) {
      ++repeated_;
      return true;
    }
    last_values_ = values;
    return false;
  }

  void count_skipped(const RecordSource& records) {
    if (++skipped_in_a_row_ >= most_skipped_in_a_row) complain_about_missing_keys(records);
  }

  [[noreturn]] void complain_about_missing_keys(const RecordSource& records) const {
    const std::vector<std::string> missing = records.missing();
    if (missing.empty()) {
      throw InputError(fmt::format("{}: {} is not a finite number, nor is any after it", name_,
                                   first_timeless_));
    }
    throw InputError(
        fmt::format("{}: needed keys are missing: {}", name_, fmt::join(missing, ", ")));
  }

  std::string name_;
  LogPresence needed_ = needed_values();
  HeldServos held_servos_;
  std::uint64_t records_ = 0;
  std::uint64_t skipped_ = 0;
  std::uint64_t skipped_in_a_row_ = 0;
  std::uint64_t timeless_ = 0;
  std::string first_timeless_;  ///< position of the record
  std::uint64_t malformed_ = 0;
  std::string first_malformed_;  ///< position of the record and its errors
  std::uint64_t repeated_ = 0;
  LogValues last_values_{};  ///< of the last row, without its wall time
  bool has_rows_ = false;
};

LogReader::LogReader(const std::filesystem::path& path, const std::atomic<bool>* stop)
    : LogReader(file_source(path, stop), path == "-" ? "standard input" : path.string()) {}

LogReader::LogReader(ByteSource source, const std::string& name)
    : LogReader(packed_records(std::move(source), name), name) {}

LogReader::LogReader(std::unique_ptr<RecordSource> records, std::string name)
    : records_(std::move(records)),
      name_(std::move(name)),
      cleaning_(std::make_unique<Cleaning>(name_)) {}

LogReader::LogReader(LogReader&& other) noexcept = default;
LogReader::~LogReader() = default;

std::vector<std::string> LogReader::warnings() const {
  std::vector<std::string> all = std::as_const(*records_).notes().warnings;
  const std::vector<std::string> of_values = cleaning_->warnings();
  all.insert(all.end(), of_values.begin(), of_values.end());
  return all;
}

std::optional<LogRow> LogReader::next() {
  if (!ahead_.empty()) {
    current_ = std::move(ahead_.front());
    ahead_.pop_front();
  } else {
    read_entry(current_);
  }
  return current_.row;
}

const RecordingInfo& LogReader::info() {
  if (!info_) look_ahead(1);
  if (!info_) info_.emplace().robot = robot_;
  info_->folder = std::filesystem::path(name_).parent_path();
  if (!has_period_) {
    look_ahead(rows_for_period);
    std::vector<double> times;
    for (const Entry& entry : ahead_) {
      if (!entry.row) break;
      times.push_back(entry.row->observation.time);
    }
    if (times.size() > 1) info_->control_period_us = period_us_of(times);
    has_period_ = true;
  }
  return *info_;
}

std::int64_t LogReader::period_us_of(const std::vector<double>& times) const {
  const std::optional<double> step = typical_step(times);
  const auto first_back = std::ranges::adjacent_find(times, std::greater<>());
  if (!step && first_back != times.end()) {
    throw InputError(fmt::format(
        "{}: observation.time: times decrease from record {} on: sort the records by time", name_,
        first_back - times.begin() + 2));
  }
  if (!step) {
    throw InputError(
        fmt::format("{}: observation.time: expected times that increase within 200 rows: do the "
                    "stamps have seconds alone, or did they lose digits? Of a log that has no "
                    "clock, `period:` in a mapping gives the time between two rows",
                    name_));
  }
  if (const std::string unit = unit_of_step(*step); !unit.empty()) {
    complain_about_unit(*step, unit);
  }
  const double microseconds = std::round(1e6 * *step);
  constexpr double longest = 1e9;
  return static_cast<std::int64_t>(std::clamp(microseconds, 1.0, longest));
}

/// Without a look ahead, which would delay a live log.
void LogReader::compare_clock_with_period(double time) {
  if (first_times_.size() >= rows_for_unit) return;
  first_times_.push_back(time);
  if (first_times_.size() < rows_for_unit) return;
  const double step = typical_step(first_times_).value_or(0.0);
  const std::string unit = unit_of_step(step, 1e-6 * static_cast<double>(info_->control_period_us));
  if (!unit.empty()) complain_about_unit(step, unit);
}

void LogReader::look_ahead(std::size_t rows) {
  while (ahead_.size() < rows && (ahead_.empty() || ahead_.back().row)) {
    Entry entry;
    read_entry(entry);
    ahead_.push_back(std::move(entry));
  }
}

void LogReader::read_entry(Entry& entry) {
  entry.row.reset();
  entry.record.clear();
  entry.skipped.clear();
  while (records_->next()) {
    if (!info_) records_->read_origin(info_, robot_);
    entry.row = cleaning_->row_of(*records_);
    if (!entry.row) {
      entry.skipped += records_->bytes();
      continue;
    }
    double& time = entry.row->observation.time;
    if (!start_time_) start_time_ = info_ ? 0.0 : time;
    if (*start_time_ != 0.0) time -= *start_time_;
    if (info_) {
      has_period_ = true;
      compare_clock_with_period(time);
    }
    entry.stamp = records_->stamp();
    entry.record = records_->bytes();
    return;
  }
  if (!info_) records_->read_origin(info_, robot_);  // of a run without steps
  cleaning_->finish(*records_, info_.has_value());
}

void LogReader::complain_about_unit(double step, const std::string& unit) const {
  throw InputError(fmt::format(
      "{}: observation.time: expected seconds: steps of {:.6g} look like {}", name_, step, unit));
}

}  // namespace touchdown::logs
