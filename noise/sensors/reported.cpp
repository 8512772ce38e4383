#include "noise/sensors/reported.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>

#include "noise/sensors/clock.hpp"
#include "noise/sensors/values.hpp"

namespace touchdown::noise {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<NoiseChannel, models::servo_count> torque_channels = {
    NoiseChannel::left_hip_torque,   NoiseChannel::left_knee_torque,
    NoiseChannel::left_wheel_torque, NoiseChannel::right_hip_torque,
    NoiseChannel::right_knee_torque, NoiseChannel::right_wheel_torque};
constexpr std::array<NoiseChannel, models::servo_count> position_channels = {
    NoiseChannel::left_hip_position,   NoiseChannel::left_knee_position,
    NoiseChannel::left_wheel_position, NoiseChannel::right_hip_position,
    NoiseChannel::right_knee_position, NoiseChannel::right_wheel_position};
constexpr std::array<NoiseChannel, models::servo_count> velocity_channels = {
    NoiseChannel::left_hip_velocity,   NoiseChannel::left_knee_velocity,
    NoiseChannel::left_wheel_velocity, NoiseChannel::right_hip_velocity,
    NoiseChannel::right_knee_velocity, NoiseChannel::right_wheel_velocity};

using AxisNumbers = std::array<NoiseChannel, 3>;
constexpr AxisNumbers accelerometer_channels = {
    NoiseChannel::accelerometer_x, NoiseChannel::accelerometer_y, NoiseChannel::accelerometer_z};
constexpr AxisNumbers gyroscope_channels = {NoiseChannel::gyroscope_x, NoiseChannel::gyroscope_y,
                                            NoiseChannel::gyroscope_z};
constexpr AxisNumbers orientation_channels = {
    NoiseChannel::orientation_x, NoiseChannel::orientation_y, NoiseChannel::orientation_z};

/// One number of every observation on its way through its sensor.
struct Column {
  SensorChannel channel;
  NoiseChannel number;
  NoiseChannel clock;  ///< whose drops it shares
  std::function<void(std::span<const models::Observation>, double*)> take;
  std::function<void(const double*, std::span<models::Observation>)> put;
  std::vector<double> values = {};
};

template <typename At>
Column column_of(const SensorChannel& channel, NoiseChannel number, NoiseChannel clock, At at) {
  return {channel, number, clock,
          [at](std::span<const models::Observation> from, double* to) {
            for (const models::Observation& observation : from) *to++ = at(observation);
          },
          [at](const double* from, std::span<models::Observation> to) {
            for (models::Observation& observation : to) at(observation) = *from++;
          }};
}

/// One run on its way through the sensors.
class Reporter {
 public:
  Reporter(const NoiseKey& key, double period, std::vector<models::Observation>& observations)
      : key_(key), period_(period), observations_(observations) {}

  /// Turns what all of the IMU measures.
  void misalign(const Misalignment& misalignment);
  /// Each of these takes its values before any is put back: wheels shake by how they turn, not by
  /// what their encoders report.
  void add_joints(const JointChannels& channels, double models::ServoReading::*member,
                  const std::array<NoiseChannel, models::servo_count>& numbers);
  void add_vector(const AxisChannels& channels, Eigen::Vector3d models::ImuReading::*member,
                  const AxisNumbers& numbers);
  void report_orientation(const AxisChannels& channels);
  void report_columns();
  /// Leaves of the reported proper acceleration what is not gravity along the reported vertical.
  void remove_gravity(const Eigen::Vector3d& gravity);
  void strike_out_missing();

 private:
  /// Calls `part(block, first step)` for block after block: so few observations that all of their
  /// numbers stay at hand while column after column is copied.
  template <typename Part>
  void for_each_block(const Part& part) {
    constexpr std::size_t steps = 64;
    for (std::size_t k = 0; k < observations_.size(); k += steps) {
      part(std::span(observations_).subspan(k, std::min(steps, observations_.size() - k)), k);
    }
  }

  const TurnsOfBoth* turns_of(const Vibration& vibration);

  NoiseKey key_;
  double period_;
  std::vector<models::Observation>& observations_;
  std::vector<Column> columns_;
  std::vector<std::uint8_t> missing_;    ///< by step; empty while no record is
  std::map<double, TurnsOfBoth> turns_;  ///< by order
};

void Reporter::misalign(const Misalignment& misalignment) {
  const auto angle = [&](double given, NoiseChannel axis) {
    if (misalignment.sd == 0.0) return given;
    return given + misalignment.sd * ChannelDraws(key_, axis).constant(DrawnFor::misalignment);
  };
  const Eigen::Quaterniond turn =
      Eigen::AngleAxisd(angle(misalignment.yaw, NoiseChannel::orientation_z),
                        Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(angle(misalignment.pitch, NoiseChannel::orientation_y),
                        Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(angle(misalignment.roll, NoiseChannel::orientation_x),
                        Eigen::Vector3d::UnitX());
  const Eigen::Matrix3d nominal_to_chip = turn.toRotationMatrix().transpose();
  for (models::Observation& observation : observations_) {
    models::ImuReading& imu = observation.imu;
    imu.raw_linear_acceleration = nominal_to_chip * imu.raw_linear_acceleration;
    imu.angular_velocity = nominal_to_chip * imu.angular_velocity;
    imu.orientation = imu.orientation * turn;
  }
}

void Reporter::add_joints(const JointChannels& channels, double models::ServoReading::*member,
                          const std::array<NoiseChannel, models::servo_count>& numbers) {
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    const SensorChannel& channel = channels[servo % channels.size()];
    if (is_ideal(channel)) continue;
    columns_.push_back(column_of(
        channel, numbers[servo], numbers[servo], [ servo, member ](auto& observation) -> auto& {
          return observation.servo[servo].*member;
        }));
  }
}

void Reporter::add_vector(const AxisChannels& channels, Eigen::Vector3d models::ImuReading::*member,
                          const AxisNumbers& numbers) {
  for (std::size_t axis = 0; axis < channels.size(); ++axis) {
    if (is_ideal(channels[axis])) continue;
    columns_.push_back(column_of(
        channels[axis], numbers[axis], numbers.front(),
        [ axis, member ](auto& observation) -> auto& {
          return (observation.imu.*member)[static_cast<Eigen::Index>(axis)];
        }));
  }
}

const TurnsOfBoth* Reporter::turns_of(const Vibration& vibration) {
  if (vibration.amplitude == 0.0) return nullptr;
  const auto [found, is_new] = turns_.try_emplace(vibration.order);
  if (is_new) {
    std::array<std::vector<double>, models::wheel_count> position, velocity;
    for (const models::Observation& observation : observations_) {
      for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
        const models::ServoReading& reading =
            observation.servo[models::index(models::wheel_servos[wheel])];
        position[wheel].push_back(reading.position);
        velocity[wheel].push_back(reading.velocity);
      }
    }
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      found->second[wheel] = wheel_turns(position[wheel], velocity[wheel], vibration.order);
    }
  }
  return &found->second;
}

void Reporter::report_orientation(const AxisChannels& channels) {
  std::array<std::vector<double>, 3> error;
  for (std::size_t axis = 0; axis < channels.size(); ++axis) {
    ChannelDraws draws(key_, orientation_channels[axis]);
    error[axis].resize(observations_.size());
    disturb_values(error[axis], channels[axis], period_, draws);
  }
  std::vector<Eigen::Quaterniond> reported;
  reported.reserve(observations_.size());
  for (std::size_t k = 0; k < observations_.size(); ++k) {
    const Eigen::Quaterniond turn(1.0, 0.5 * error[0][k], 0.5 * error[1][k], 0.5 * error[2][k]);
    reported.push_back(observations_[k].imu.orientation * turn.normalized());
  }
  disturb_clock<Eigen::Quaterniond>(reported, channels.front(), period_,
                                    {key_, orientation_channels.front()}, {nan, nan, nan, nan},
                                    missing_);
  for (std::size_t k = 0; k < observations_.size(); ++k) {
    observations_[k].imu.orientation = reported[k];
  }
}

void Reporter::report_columns() {
  for (Column& column : columns_) column.values.resize(observations_.size());
  for_each_block([&](std::span<const models::Observation> block, std::size_t first) {
    for (Column& column : columns_) column.take(block, column.values.data() + first);
  });
  for (Column& column : columns_) {
    ChannelDraws draws(key_, column.number);
    disturb_values(column.values, column.channel, period_, draws,
                   turns_of(column.channel.vibration));
    disturb_clock<double>(column.values, column.channel, period_, {key_, column.clock}, nan,
                          missing_);
  }
  for_each_block([&](std::span<models::Observation> block, std::size_t first) {
    for (const Column& column : columns_) column.put(column.values.data() + first, block);
  });
}

void Reporter::remove_gravity(const Eigen::Vector3d& gravity) {
  for (models::Observation& observation : observations_) {
    models::ImuReading& imu = observation.imu;
    imu.linear_acceleration = imu.raw_linear_acceleration + imu.orientation.conjugate() * gravity;
  }
}

void Reporter::strike_out_missing() {
  models::Observation nothing;
  nothing.time = nothing.pitch = nothing.pitch_rate = nothing.yaw = nothing.yaw_rate = nan;
  nothing.servo.fill({nan, nan, nan});
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(nan);
  nothing.imu = {Eigen::Quaterniond(nan, nan, nan, nan), none, none, none};
  for (std::size_t k = 0; k < missing_.size(); ++k) {
    if (missing_[k] != 0) observations_[k] = nothing;
  }
}

}  // namespace

void report_through(const SensorProfile& profile, const NoiseKey& key, double period,
                    std::vector<models::Observation>& observations) {
  if (observations.empty() || is_ideal(profile)) return;
  Reporter reporter(key, period, observations);
  // In the frame of the attitude reference system, the same throughout the run.
  const models::ImuReading& first = observations.front().imu;
  const Eigen::Vector3d gravity =
      first.orientation * (first.linear_acceleration - first.raw_linear_acceleration);
  const bool is_aligned = profile.misalignment == Misalignment();
  const bool is_attitude_ideal = is_ideal(profile.orientation);
  if (!is_aligned) reporter.misalign(profile.misalignment);
  reporter.add_vector(profile.accelerometer, &models::ImuReading::raw_linear_acceleration,
                      accelerometer_channels);
  reporter.add_vector(profile.gyroscope, &models::ImuReading::angular_velocity, gyroscope_channels);
  reporter.add_joints(profile.torque, &models::ServoReading::torque, torque_channels);
  reporter.add_joints(profile.position, &models::ServoReading::position, position_channels);
  reporter.add_joints(profile.velocity, &models::ServoReading::velocity, velocity_channels);
  reporter.report_columns();
  if (!is_attitude_ideal) reporter.report_orientation(profile.orientation);
  if (!is_aligned || !is_attitude_ideal || !is_ideal(profile.accelerometer)) {
    reporter.remove_gravity(gravity);
  }
  reporter.strike_out_missing();
}

}  // namespace touchdown::noise
