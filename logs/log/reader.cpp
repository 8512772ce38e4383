#include "logs/log/reader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/log/packing.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

namespace {

double time_of(const LogValues& values, const LogPresence& present) {
  return values[present[log_slot::time] ? log_slot::time : log_slot::wall_time];
}

}  // namespace

HeldServos::HeldServos() {
  for (const LogKey& key : log_keys()) {
    if (key.role != LogKey::Role::needed) continue;
    for (std::size_t i = 0; i < key.size; ++i) needed_.set(key.slot + i);
  }
}

bool HeldServos::complete(LogValues& values, LogPresence& present) {
  if (!is_started_) return false;
  if (!present[log_slot::time] && !present[log_slot::wall_time]) return false;
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

void HeldServos::remember(const LogValues& values, const LogPresence& present) {
  is_started_ = true;
  const double now = time_of(values, present);
  for (std::size_t i = 0; i < count; ++i) held_[i] = {values[log_slot::servo + i], now};
}

namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 18U;
/// Larger than any record. A longer one is garbage that looks like a header.
constexpr std::size_t largest_record = std::size_t{1} << 23U;
/// Until all of its observers run, a spine logs incomplete records; two seconds are too long.
constexpr std::uint64_t most_skipped_in_a_row = 2000;
constexpr std::size_t rows_for_period = 200;
/// With fewer rows, long steps may be pauses.
constexpr std::size_t rows_for_unit = 11;
/// Beyond any clock in any unit: nanoseconds since 1970 are 2e18.
constexpr double largest_time = 1e20;

}  // namespace

LogReader::LogReader(const std::filesystem::path& path, const std::atomic<bool>* stop)
    : LogReader(file_source(path, stop), path == "-" ? "standard input" : path.string()) {}

LogReader::LogReader(ByteSource source, std::string name)
    : source_(std::move(source)), name_(std::move(name)) {}

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
  if (!step) {
    throw InputError(
        fmt::format("{}: observation.time: expected times that increase: of a log that has no "
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
  while (parse_record()) {
    const std::string_view record(buffer_.data() + begin_, record_size_);
    begin_ += record_size_;
    offset_ += record_size_;
    ++record_count_;
    if (parser_.has_config() && !info_) {
      info_ = unpack_info(record, name_);
      if (!info_) robot_ = unpack_robot(record);
    }
    LogValues values = parser_.values();
    LogPresence present = parser_.present();
    const bool lacks_keys = parser_.is_missing_any() && !is_completed(values, present);
    if (lacks_keys) {
      ++skipped_count_;
      count_malformed();
    } else {
      if (!parser_.is_missing_any()) held_servos_.remember(values, present);
      entry.row = to_row(values, present);
      double& time = entry.row->observation.time;
      if (!(std::abs(time) <= largest_time)) time = std::numeric_limits<double>::quiet_NaN();
    }
    if (!lacks_keys && repeats_last()) {
      entry.row.reset();
      entry.skipped += record;
      continue;
    }
    if (lacks_keys || is_without_time(*entry.row)) {
      entry.row.reset();
      if (++skipped_in_a_row_ >= most_skipped_in_a_row) complain_about_missing_keys();
      entry.skipped += record;
      continue;
    }
    skipped_in_a_row_ = 0;
    has_rows_ = true;
    double& time = entry.row->observation.time;
    if (!start_time_) start_time_ = info_ ? 0.0 : time;
    if (*start_time_ != 0.0) time -= *start_time_;
    if (info_) {
      has_period_ = true;
      compare_clock_with_period(time);
    }
    entry.record = record;
    return;
  }
}

/// Applies before the first row only, which defines time zero. Later the guard of an estimator
/// checks the time.
bool LogReader::is_without_time(const LogRow& row) {
  if (has_rows_ || std::isfinite(row.observation.time)) return false;
  if (++timeless_count_ == 1) {
    first_timeless_ =
        fmt::format("byte {}: the time of record {}", offset_ - record_size_, record_count_);
  }
  return true;
}

/// Whether missing numbers of servos could be held from an earlier record. A value of another type
/// is no missing number.
bool LogReader::is_completed(LogValues& values, LogPresence& present) {
  return parser_.malformed().empty() && held_servos_.complete(values, present);
}

/// Whether the record has the time and all numbers of the last row: it was written twice.
bool LogReader::repeats_last() {
  LogValues values = parser_.values();
  if (parser_.present()[log_slot::time]) values[log_slot::wall_time] = 0.0;
  // By bits, because missing commands are NaN.
  const auto is_same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  if (has_rows_ && std::equal(values.begin(), values.end(), last_values_.begin(), is_same)) {
    ++repeated_count_;
    return true;
  }
  last_values_ = values;
  return false;
}

void LogReader::count_malformed() {
  const std::vector<std::string> malformed = parser_.malformed();
  if (malformed.empty() || ++malformed_count_ > 1) return;
  first_malformed_ = fmt::format("byte {}: record {} has {}", offset_ - record_size_, record_count_,
                                 fmt::join(malformed, ", "));
}

bool LogReader::parse_record() {
  while (true) {
    if (begin_ == end_ && !refill()) {
      finish();
      return false;
    }
    const std::string_view bytes(buffer_.data() + begin_, end_ - begin_);
    const LogParser::Result result = parser_.parse(bytes, record_size_);
    if (result == LogParser::Result::record) return true;
    if (result == LogParser::Result::garbage || bytes.size() > largest_record) {
      complain_about_garbage(result == LogParser::Result::garbage ? record_size_ : 0);
    }
    if (refill()) continue;
    if (record_count_ == 0) complain_about_garbage(0);
    warnings_.push_back(
        fmt::format("{}: byte {}: the last record is cut off after {} bytes and was left out",
                    name_, offset_, bytes.size()));
    begin_ = end_;
    finish();
    return false;
  }
}

bool LogReader::refill() {
  if (at_end_) return false;
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < end_ + chunk_size) buffer_.resize(2 * (end_ + chunk_size));
  const std::size_t size = source_(std::span(buffer_).subspan(end_, chunk_size));
  end_ += size;
  at_end_ = size == 0;
  return !at_end_;
}

void LogReader::finish() {
  if (record_count_ == 0) throw InputError(fmt::format("{}: the log is empty", name_));
  // A simulated run may end before its first step. A robot's log without rows is an error.
  if (!has_rows_ && !info_) complain_about_missing_keys();
  if (skipped_count_ > 0 && has_rows_ && !has_finished_) {
    warnings_.push_back(fmt::format("{}: {} of {} records lack needed keys and were left out",
                                    name_, skipped_count_, record_count_));
  }
  if (malformed_count_ > 0 && has_rows_ && !has_finished_) {
    warnings_.push_back(fmt::format(
        "{}: {}{}", name_, first_malformed_,
        malformed_count_ == 1 ? "" : fmt::format("; {} more like it", malformed_count_ - 1)));
  }
  if (timeless_count_ > 0 && has_rows_ && !has_finished_) {
    warnings_.push_back(fmt::format(
        "{}: {} is not a finite number: it was left out{}", name_, first_timeless_,
        timeless_count_ == 1
            ? ""
            : fmt::format(", and {} more before the first good record", timeless_count_ - 1)));
  }
  if (held_servos_.records() > 0 && !has_finished_) {
    warnings_.push_back(
        fmt::format("{}: {} of {} records lack numbers of servos: they are held from the record "
                    "before, for up to {:.4g} ms{}",
                    name_, held_servos_.records(), record_count_, 1e3 * held_servos_.oldest(),
                    held_servos_.lost() == 0
                        ? ""
                        : fmt::format("; {} records lack them for longer", held_servos_.lost())));
  }
  if (repeated_count_ > 0 && !has_finished_) {
    warnings_.push_back(
        fmt::format("{}: {} of {} records repeat the one before, with its time and all its "
                    "numbers, and were left out",
                    name_, repeated_count_, record_count_));
  }
  has_finished_ = true;
}

void LogReader::complain_about_garbage(std::size_t offset) const {
  constexpr std::array source_logs = {".csv", ".CSV", ".tsv", ".npz", ".mcap", ".db3", ".zstd"};
  const bool is_source_log =
      std::any_of(source_logs.begin(), source_logs.end(),
                  [&](const char* extension) { return name_.ends_with(extension); });
  const bool is_scenario = name_.ends_with(".yaml") || name_.ends_with(".yml");
  throw InputError(fmt::format(
      "{}: byte {}: expected a MessagePack map, one per control step{}", name_, offset_ + offset,
      is_source_log ? ": `touchdown export --mapping` makes such a log"
      : is_scenario ? ": `touchdown simulate` makes such a log of a scenario"
                    : ""));
}

void LogReader::complain_about_missing_keys() const {
  if (const auto missing = parser_.missing(); missing.empty()) {
    throw InputError(
        fmt::format("{}: {} is not a finite number, nor is any after it", name_, first_timeless_));
  }
  throw InputError(
      fmt::format("{}: needed keys are missing: {}", name_, fmt::join(parser_.missing(), ", ")));
}

void LogReader::complain_about_unit(double step, const std::string& unit) const {
  throw InputError(fmt::format(
      "{}: observation.time: expected seconds: steps of {:.6g} look like {}", name_, step, unit));
}

}  // namespace touchdown::logs
