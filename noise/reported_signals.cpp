#include "noise/reported_signals.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "noise/sensor_chain.hpp"

namespace touchdown::noise {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One scalar signal of the observations, with the state of its sensor.
struct SensorSignal {
  SensorChannel channel;
  ChannelDraws draws;
  Clock<double> clock;
  std::function<void(std::span<const models::Observation>, double*)> take;
  std::function<void(const double*, std::span<models::Observation>)> put;
  ChannelState state = {};
  std::vector<double> values = {};
};

/// The key of the random draws, and the control period (s).
struct RunKey {
  NoiseKey key;
  double period;
};

template <typename At>
SensorSignal signal_of(const SensorChannel& channel, const RunKey& run, NoiseChannel number,
                       NoiseChannel dropout_channel, At at) {
  return {channel,
          {run.key, number},
          {channel, run.period, {run.key, dropout_channel}, nan},
          [at](std::span<const models::Observation> from, double* to) {
            for (const models::Observation& observation : from) *to++ = at(observation);
          },
          [at](const double* from, std::span<models::Observation> to) {
            for (models::Observation& observation : to) at(observation) = *from++;
          }};
}

}  // namespace

/// State of sensors that are not ideal, over the run so far.
class ReportingSensors::Reporter {
 public:
  Reporter(const SensorProfile& profile, const NoiseKey& key, double period);

  void report(std::span<models::Observation> next);

 private:
  /// Add one signal per channel that is not ideal. All signals are read before any is written back:
  /// vibration follows the true wheel angle, not the reported one.
  void add_joints(const JointChannels& channels, double models::ServoReading::*member,
                  NoiseChannel (*number)(models::Servo));
  void add_vector(const AxisChannels& channels, Eigen::Vector3d models::ImuReading::*member,
                  NoiseChannel x);

  /// Rotates all measurements of the IMU.
  void misalign(std::span<models::Observation> next) const;
  void report_signals(std::span<models::Observation> next);
  void report_orientation(std::span<models::Observation> next);
  /// Computes the acceleration without gravity from the reported acceleration and orientation.
  void remove_gravity(std::span<models::Observation> next) const;
  void blank_missing_records(std::span<models::Observation> next) const;

  void turn_wheels(std::span<const models::Observation> next);

  RunKey run_;
  double leg_skew_;
  bool is_aligned_;
  bool is_attitude_ideal_;
  bool changes_acceleration_;
  Eigen::Quaterniond turn_ =
      Eigen::Quaterniond::Identity();  ///< rotation of the IMU from its nominal frame
  std::vector<SensorSignal> signals_;
  AxisChannels orientation_;
  std::array<ChannelState, 3> orientation_state_;
  Clock<Eigen::Quaterniond> orientation_clock_;
  std::map<double, TurnsOfBoth> turns_;     ///< of the current steps, by order
  std::optional<Eigen::Vector3d> gravity_;  ///< from the first step, in the attitude frame
  std::vector<std::uint8_t> missing_;       ///< marks current steps without a record; may be empty
};

namespace {

Eigen::Quaterniond turn_of(const Misalignment& misalignment, const NoiseKey& key) {
  const auto angle = [&](double given, NoiseChannel axis) {
    if (misalignment.sd == 0.0) return given;
    return given + misalignment.sd * ChannelDraws(key, axis).constant(DrawnFor::misalignment);
  };
  return Eigen::AngleAxisd(angle(misalignment.yaw, NoiseChannel::orientation_z),
                           Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angle(misalignment.pitch, NoiseChannel::orientation_y),
                           Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(angle(misalignment.roll, NoiseChannel::orientation_x),
                           Eigen::Vector3d::UnitX());
}

/// Calls `part(block, first step)` for consecutive blocks. A block is small enough to stay in the
/// cache while its signals are copied one by one.
template <typename Part>
void for_each_block(std::span<models::Observation> steps, const Part& part) {
  constexpr std::size_t most = 64;
  for (std::size_t k = 0; k < steps.size(); k += most) {
    part(steps.subspan(k, std::min(most, steps.size() - k)), k);
  }
}

}  // namespace

ReportingSensors::Reporter::Reporter(const SensorProfile& profile, const NoiseKey& key,
                                     double period)
    : run_{key, period},
      leg_skew_(profile.leg_skew),
      is_aligned_(profile.misalignment == Misalignment()),
      is_attitude_ideal_(is_ideal(profile.orientation)),
      changes_acceleration_(!is_aligned_ || !is_attitude_ideal_ ||
                            !is_ideal(profile.accelerometer)),
      orientation_(profile.orientation),
      orientation_clock_(profile.orientation.front(), period, {key, NoiseChannel::orientation_x},
                         {nan, nan, nan, nan}) {
  if (!is_aligned_) turn_ = turn_of(profile.misalignment, key);
  add_vector(profile.accelerometer, &models::ImuReading::raw_linear_acceleration,
             NoiseChannel::accelerometer_x);
  add_vector(profile.gyroscope, &models::ImuReading::angular_velocity, NoiseChannel::gyroscope_x);
  add_joints(profile.torque, &models::ServoReading::torque, torque_channel);
  add_joints(profile.position, &models::ServoReading::position, position_channel);
  add_joints(profile.velocity, &models::ServoReading::velocity, velocity_channel);
}

void ReportingSensors::Reporter::add_joints(const JointChannels& channels,
                                            double models::ServoReading::*member,
                                            NoiseChannel (*number)(models::Servo)) {
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    SensorChannel channel = channels[servo % channels.size()];
    if (servo >= channels.size()) channel.delay += leg_skew_;  // the right leg's
    if (is_ideal(channel)) continue;
    const NoiseChannel own = number(static_cast<models::Servo>(servo));
    signals_.push_back(signal_of(
        channel, run_, own, own, [ servo, member ](auto& observation) -> auto& {
          return observation.servo[servo].*member;
        }));
  }
}

void ReportingSensors::Reporter::add_vector(const AxisChannels& channels,
                                            Eigen::Vector3d models::ImuReading::*member,
                                            NoiseChannel x) {
  for (std::size_t axis = 0; axis < channels.size(); ++axis) {
    if (is_ideal(channels[axis])) continue;
    signals_.push_back(signal_of(
        channels[axis], run_, axis_channel(x, axis), x,
        [ axis, member ](auto& observation) -> auto& {
          return (observation.imu.*member)[static_cast<Eigen::Index>(axis)];
        }));
  }
}

void ReportingSensors::Reporter::report(std::span<models::Observation> next) {
  if (next.empty()) return;
  if (!gravity_) {
    // In the frame of the attitude reference system, where gravity is constant.
    const models::ImuReading& first = next.front().imu;
    gravity_ = first.orientation * (first.linear_acceleration - first.raw_linear_acceleration);
  }
  missing_.clear();
  if (!is_aligned_) misalign(next);
  report_signals(next);
  if (!is_attitude_ideal_) report_orientation(next);
  if (changes_acceleration_) remove_gravity(next);
  blank_missing_records(next);
}

void ReportingSensors::Reporter::misalign(std::span<models::Observation> next) const {
  const Eigen::Matrix3d nominal_to_chip = turn_.toRotationMatrix().transpose();
  for (models::Observation& observation : next) {
    models::ImuReading& imu = observation.imu;
    imu.raw_linear_acceleration = nominal_to_chip * imu.raw_linear_acceleration;
    imu.angular_velocity = nominal_to_chip * imu.angular_velocity;
    imu.orientation = imu.orientation * turn_;
  }
}

void ReportingSensors::Reporter::turn_wheels(std::span<const models::Observation> next) {
  turns_.clear();
  for (const SensorSignal& signal : signals_) {
    const Vibration& vibration = signal.channel.vibration;
    if (vibration.amplitude == 0.0) continue;
    const auto [found, is_new] = turns_.try_emplace(vibration.order);
    if (!is_new) continue;
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      std::vector<double> position, velocity;
      for (const models::Observation& observation : next) {
        const models::ServoReading& reading =
            observation.servo[models::index(models::wheel_servos[wheel])];
        position.push_back(reading.position);
        velocity.push_back(reading.velocity);
      }
      found->second[wheel] = wheel_turns(position, velocity, vibration.order);
    }
  }
}

void ReportingSensors::Reporter::report_signals(std::span<models::Observation> next) {
  turn_wheels(next);
  for (SensorSignal& signal : signals_) signal.values.resize(next.size());
  for_each_block(next, [&](std::span<const models::Observation> block, std::size_t first) {
    for (SensorSignal& signal : signals_) signal.take(block, signal.values.data() + first);
  });
  for (SensorSignal& signal : signals_) {
    const auto turns = turns_.find(signal.channel.vibration.order);
    const bool vibrates = signal.channel.vibration.amplitude != 0.0;
    disturb_values(signal.values, signal.channel, run_.period, signal.draws, signal.state,
                   vibrates ? &turns->second : nullptr);
    signal.clock.report(signal.values, missing_);
  }
  for_each_block(next, [&](std::span<models::Observation> block, std::size_t first) {
    for (const SensorSignal& signal : signals_) signal.put(signal.values.data() + first, block);
  });
}

void ReportingSensors::Reporter::report_orientation(std::span<models::Observation> next) {
  std::array<std::vector<double>, 3> error;
  for (std::size_t axis = 0; axis < orientation_.size(); ++axis) {
    ChannelDraws draws(run_.key, axis_channel(NoiseChannel::orientation_x, axis));
    error[axis].resize(next.size());
    disturb_values(error[axis], orientation_[axis], run_.period, draws, orientation_state_[axis]);
  }
  std::vector<Eigen::Quaterniond> reported;
  reported.reserve(next.size());
  for (std::size_t k = 0; k < next.size(); ++k) {
    const Eigen::Quaterniond turn(1.0, 0.5 * error[0][k], 0.5 * error[1][k], 0.5 * error[2][k]);
    reported.push_back(next[k].imu.orientation * turn.normalized());
  }
  orientation_clock_.report(reported, missing_);
  for (std::size_t k = 0; k < next.size(); ++k) next[k].imu.orientation = reported[k];
}

void ReportingSensors::Reporter::remove_gravity(std::span<models::Observation> next) const {
  for (models::Observation& observation : next) {
    models::ImuReading& imu = observation.imu;
    imu.linear_acceleration = imu.raw_linear_acceleration + imu.orientation.conjugate() * *gravity_;
  }
}

void ReportingSensors::Reporter::blank_missing_records(std::span<models::Observation> next) const {
  models::Observation nothing;
  nothing.time = nothing.pitch = nothing.pitch_rate = nothing.yaw = nothing.yaw_rate = nan;
  nothing.servo.fill({nan, nan, nan});
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(nan);
  nothing.imu = {Eigen::Quaterniond(nan, nan, nan, nan), none, none, none};
  for (std::size_t k = 0; k < missing_.size(); ++k) {
    if (missing_[k] != 0) next[k] = nothing;
  }
}

ReportingSensors::ReportingSensors(const SensorProfile& profile, const NoiseKey& key, double period)
    : reporter_(is_ideal(profile) ? nullptr : std::make_unique<Reporter>(profile, key, period)) {}
ReportingSensors::~ReportingSensors() = default;
ReportingSensors::ReportingSensors(ReportingSensors&&) noexcept = default;
ReportingSensors& ReportingSensors::operator=(ReportingSensors&&) noexcept = default;

void ReportingSensors::report(std::span<models::Observation> next) {
  if (reporter_) reporter_->report(next);
}

void report_targets(const SensorProfile& profile, const NoiseKey& key,
                    std::span<models::Action> actions) {
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    const SensorChannel& channel = profile.position[servo % profile.position.size()];
    const double zero =
        bias_of(channel, {key, position_channel(static_cast<models::Servo>(servo))});
    if (zero == 0.0) continue;
    for (models::Action& action : actions) action.servo[servo].position += zero;
  }
}

void report_through(const SensorProfile& profile, const NoiseKey& key, double period,
                    std::vector<models::Observation>& observations) {
  ReportingSensors(profile, key, period).report(observations);
}

}  // namespace touchdown::noise
