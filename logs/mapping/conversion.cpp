#include "logs/mapping/conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "estimator/record.hpp"
#include "logs/bags/bag.hpp"
#include "logs/log/writer.hpp"
#include "logs/mapping/mapping_file.hpp"
#include "logs/mapping/source_log.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

namespace {

Eigen::Vector3d vector_of(const MappedSignal& signal, std::span<const double> row) {
  return {signal.value(row, 0), signal.value(row, 1), signal.value(row, 2)};
}

/// The IMU of a row, in Upkie's frames.
ImuSignals imu_of(const LogMapping& mapping, std::span<const double> row) {
  RobotRecord record{.angular_velocity = vector_of(mapping.angular_velocity, row)};
  for (std::size_t i = 0; i < 4; ++i) {
    record.orientation.at(mapping.is_w_last ? (i + 1) % 4 : i) = mapping.orientation.value(row, i);
  }
  if (mapping.linear_acceleration) {
    record.linear_acceleration = vector_of(*mapping.linear_acceleration, row);
  }
  if (mapping.proper_acceleration) {
    record.proper_acceleration = vector_of(*mapping.proper_acceleration, row);
  }
  return touchdown::imu_of(record, mapping.conventions);
}

void put(LogValues& values, std::size_t slot, const Eigen::Vector3d& vector) {
  std::copy(vector.begin(), vector.end(), values.begin() + static_cast<std::ptrdiff_t>(slot));
}

constexpr std::size_t velocity_target(models::Servo wheel) {
  return log_slot::command + 6 * models::index(wheel) + 2;
}

constexpr std::array<models::Servo, 4> leg_servos = {
    models::Servo::left_hip, models::Servo::left_knee, models::Servo::right_hip,
    models::Servo::right_knee};

/// The slots of a servo's feed-forward torque, position, velocity and scales of its gains.
constexpr std::size_t command_of(models::Servo servo) {
  return log_slot::command + 6 * models::index(servo);
}
constexpr std::size_t leg_command_size = 5;

void put_leg_targets(const MappedLegTargets& targets, std::span<const double> row,
                     LogValues& values) {
  for (std::size_t i = 0; i < leg_servos.size(); ++i) {
    double* const command = values.data() + command_of(leg_servos[i]);
    command[0] = targets.torque ? targets.torque->value(row, i) : 0.0;
    command[1] = targets.position.value(row, i);
    command[2] = targets.velocity ? targets.velocity->value(row, i) : 0.0;
    command[3] = targets.kp[i] / models::servo_kp;
    command[4] = targets.kd[i] / models::servo_kd;
  }
}

/// Converts one row to the numbers of a record.
LogValues log_values(const LogMapping& mapping, std::uint64_t k, std::span<const double> row) {
  LogValues values{};
  values[log_slot::time] =
      mapping.time ? mapping.time->at(row) : static_cast<double>(k) * mapping.period;
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    const std::size_t slot = log_slot::servo + 3 * servo;
    values[slot] = mapping.position.value(row, servo);
    values[slot + 1] = mapping.velocity.value(row, servo);
    values[slot + 2] = mapping.torque.value(row, servo);
  }
  const ImuSignals imu = imu_of(mapping, row);
  std::copy(imu.orientation.begin(), imu.orientation.end(),
            values.begin() + log_slot::imu_orientation);
  put(values, log_slot::angular_velocity, imu.angular_velocity);
  put(values, log_slot::linear_acceleration, imu.linear_acceleration);
  if (mapping.proper_acceleration) put(values, log_slot::raw_acceleration, imu.proper_acceleration);
  if (mapping.wheel_velocity_target) {
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      values[velocity_target(models::wheel_servos[wheel])] =
          mapping.wheel_velocity_target->value(row, wheel);
    }
  }
  if (mapping.leg_targets) put_leg_targets(*mapping.leg_targets, row, values);
  return values;
}

/// Marks the numbers that a record has.
LogPresence log_presence(const LogMapping& mapping) {
  LogPresence present;
  present.set(log_slot::time);
  for (std::size_t slot = log_slot::servo; slot < log_slot::raw_angular_velocity; ++slot) {
    present.set(slot);
  }
  if (mapping.proper_acceleration) present.set(log_slot::raw_acceleration);
  if (mapping.wheel_velocity_target) {
    for (const models::Servo wheel : models::wheel_servos) present.set(velocity_target(wheel));
  }
  if (mapping.leg_targets) {
    for (const models::Servo servo : leg_servos) {
      for (std::size_t i = 0; i < leg_command_size; ++i) present.set(command_of(servo) + i);
    }
  }
  return present;
}

/// Builds contact intervals from the contact labels of the rows.
class IntervalBuilder {
 public:
  IntervalBuilder(const LogMapping& mapping, ContactIntervals& labels)
      : mapping_(mapping), labels_(labels) {}

  /// `time` counts from the first time of the log.
  void add(double time, std::span<const double> row, const SourceLocation& place) {
    if (!mapping_.contact || !std::isfinite(time)) return;
    if (time < last_) {
      throw InputError(fmt::format(
          "{}: contact labels need increasing times: {} s comes after {} s", place(), time, last_));
    }
    const std::optional<std::array<bool, models::wheel_count>> contact = contact_in(row);
    const bool continues = open_ && contact == labels_.intervals.back().contact;
    if (open_ && !continues) end(time);
    if (contact && !continues) labels_.intervals.push_back({time, time, *contact});
    open_ = contact.has_value();
    last_ = time;
    ++rows_;
  }

  /// Ends the last interval: the last row lasts as long as the mean of the others.
  void finish() {
    if (open_) end(last_ + last_ / std::max<double>(1.0, static_cast<double>(rows_) - 1.0));
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
  ContactIntervals& labels_;
  bool open_ = false;
  double last_ = 0.0;
  std::uint64_t rows_ = 0;
};

/// Converts a log row by row. The mapping is read once the names of the log are known.
class Converter {
 public:
  Converter(const std::filesystem::path& mapping, std::ostream& stream, bool with_labels)
      : path_(mapping), stream_(stream), with_labels_(with_labels) {}

  const LogMapping& begin(std::span<const SourceNames> sources) {
    mapping_ = read_log_mapping(path_, sources);
    writer_.emplace(stream_, log_presence(mapping_), mapping_.robot);
    intervals_.emplace(mapping_, converted_.contact);
    hold_.emplace(mapping_);
    return mapping_;
  }

  void add(std::span<const double> given, const SourceLocation& place) {
    row_.assign(given.begin(), given.end());
    const double given_time = mapping_.time
                                  ? mapping_.time->at(given)
                                  : static_cast<double>(converted_.rows) * mapping_.period;
    if (!hold_->complete(row_, given_time)) {
      if (has_time_) add_labels(given_time - converted_.start, given, place);
      return;
    }
    const std::span<const double> row = row_;
    const LogValues values = log_values(mapping_, converted_.rows++, row);
    writer_->write(values);
    first_step_.add(values[log_slot::time]);
    const bool is_whole =
        std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
    if (!is_whole) ++converted_.incomplete_rows;
    const double time = values[log_slot::time];
    if (std::isfinite(time)) {
      if (has_time_) {
        if (time < converted_.end) ++converted_.time_reversals;
        if (time > converted_.end + longest_period) ++long_steps_;
      } else {
        converted_.start = time;
      }
      converted_.end = time;
      has_time_ = true;
    }
    add_labels(time - converted_.start, row, place);
  }

  ConvertedLog finish(const std::filesystem::path& log) {
    if (converted_.rows == 0) throw InputError(fmt::format("{}: holds no rows", log.string()));
    if (!has_time_) {
      throw InputError(fmt::format("{}: no row has a time that is a finite number", log.string()));
    }
    check_clock(log);
    if (with_labels_) intervals_->finish();
    converted_.completed_rows = hold_->completed();
    converted_.oldest = hold_->oldest();
    converted_.rows_without_joints = hold_->without_joints();
    return std::move(converted_);
  }

 private:
  /// The first times of the log.
  class FirstTimes {
   public:
    void add(double time) {
      constexpr std::size_t most = 200;
      if (times_.size() < most) times_.push_back(time);
    }
    std::optional<double> step() const { return typical_step(times_); }

   private:
    std::vector<double> times_;
  };

  void add_labels(double time, std::span<const double> row, const SourceLocation& place) {
    if (with_labels_) intervals_->add(time, row, place);
  }

  /// Errors: `InputError` for a clock that counts another unit than the mapping states.
  void check_clock(const std::filesystem::path& log) const {
    const double step = first_step_.step().value_or(0.0);
    const std::string unit = unit_of_step(step);
    constexpr std::uint64_t few = 10;  // rows: their steps may be pauses
    if (!unit.empty() && converted_.rows > few && mapping_.time &&
        mapping_.time->time.unit == 1.0) {
      throw InputError(
          fmt::format("{}: times look like {}: rows are {:.6g} apart; set the `unit` of "
                      "`time`",
                      log.string(), unit, step));
    }
    if (2 * long_steps_ > converted_.rows) {
      throw InputError(fmt::format(
          "{}: most rows come more than {} s after the one before: is time in ms, us or ns? "
          "Then set its `unit`",
          log.string(), longest_period));
    }
    constexpr double shortest_step = 4e-5;  // s, at 25,000 Hz
    if (converted_.rows > few && step > 0.0 && step < shortest_step) {
      throw InputError(
          fmt::format("{}: rows are {:.3g} s apart: is the `unit` of `time` smaller "
                      "than that of the log",
                      log.string(), step));
    }
  }

  const std::filesystem::path& path_;
  std::ostream& stream_;
  bool with_labels_;
  LogMapping mapping_;
  std::optional<LogWriter> writer_;
  std::optional<IntervalBuilder> intervals_;
  std::optional<RowHold> hold_;
  std::vector<double> row_;
  FirstTimes first_step_;
  ConvertedLog converted_;
  std::uint64_t long_steps_ = 0;
  bool has_time_ = false;
};

}  // namespace

std::vector<std::string> warnings_of(const ConvertedLog& converted, const std::string& log) {
  std::vector<std::string> warnings = converted.notes;
  if (converted.incomplete_rows > 0) {
    warnings.push_back(fmt::format("{}: {} of {} rows lack a number, which is NaN in the log", log,
                                   converted.incomplete_rows, converted.rows));
  }
  if (converted.time_reversals > 0) {
    warnings.push_back(fmt::format("{}: time goes back at {} rows", log, converted.time_reversals));
  }
  if (converted.completed_rows > 0) {
    warnings.push_back(
        fmt::format("{}: {} of {} records hold numbers of an earlier row, for up to {:.4g} ms", log,
                    converted.completed_rows, converted.rows, 1e3 * converted.oldest));
  }
  if (converted.rows_without_joints > 0) {
    warnings.push_back(
        fmt::format("{}: {} rows have no number of a joint: they are no records of their own", log,
                    converted.rows_without_joints));
  }
  return warnings;
}

LogRow mapped_row(const LogMapping& mapping, std::uint64_t k, std::span<const double> row) {
  return to_row(log_values(mapping, k, row), log_presence(mapping));
}

ConvertedLog convert_log(const std::filesystem::path& log, const std::filesystem::path& mapping,
                         std::ostream& stream, const std::function<void()>& check_stop,
                         bool with_labels) {
  Converter converter(mapping, stream, with_labels);
  std::vector<std::string> notes;
  const auto row = [&](std::span<const double> numbers, const SourceLocation& place) {
    if (check_stop) check_stop();
    converter.add(numbers, place);
  };
  const LogSources sources = read_log_sources(mapping);
  if (!sources.empty() || is_bag(log)) {
    notes =
        read_joined_log(log, sources,
                        {.mapping = [&](std::span<const SourceNames> names) -> const LogMapping& {
                           return converter.begin(names);
                         },
                         .row = row});
  } else {
    read_source_log(log, {.wanted =
                              [&](const SourceNames& names) {
                                return converter.begin(std::span(&names, 1)).columns;
                              },
                          .row = row,
                          .note = [&](const std::string& line) { notes.push_back(line); }});
  }
  ConvertedLog converted = converter.finish(log);
  converted.notes.insert(converted.notes.end(), notes.begin(), notes.end());
  return converted;
}

MappedLog::MappedLog(const std::filesystem::path& log, const std::filesystem::path& mapping,
                     const std::function<void()>& check_stop)
    : folder_(temporary_folder() / "touchdown_mapped_log") {
  std::ofstream stream(path(), std::ios::binary);
  const ConvertedLog converted = convert_log(log, mapping, stream, check_stop, false);
  stream.close();
  if (!stream) {
    throw Error(fmt::format("{}: cannot be written: is the disk full?", path().string()));
  }
  warnings_ = warnings_of(converted, log.string());
}

}  // namespace touchdown::logs
