#include "noise/sensor_noise.hpp"

namespace touchdown {

namespace {

constexpr std::array<Servo, wheel_count> knees = {Servo::left_knee, Servo::right_knee};
constexpr std::array<NoiseChannel, wheel_count> knee_channels = {NoiseChannel::left_knee_torque,
                                                                 NoiseChannel::right_knee_torque};
constexpr std::array<NoiseChannel, wheel_count> wheel_channels = {NoiseChannel::left_wheel_torque,
                                                                  NoiseChannel::right_wheel_torque};
constexpr std::array<NoiseChannel, 3> accelerometer_channels = {
    NoiseChannel::accelerometer_x, NoiseChannel::accelerometer_y, NoiseChannel::accelerometer_z};

}  // namespace

Observation with_noise(const Observation& observation, const NoiseKey& key, std::uint64_t step,
                       const NoiseLevels& levels) {
  Observation noisy = observation;
  const auto add = [&](double& value, double sigma, NoiseChannel channel) {
    if (sigma > 0.0) value += sigma * standard_normal(key, channel, step);
  };
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    add(noisy.servo[index(knees[leg])].torque, levels.knee_torque, knee_channels[leg]);
    add(noisy.servo[index(wheel_servos[leg])].torque, levels.wheel_torque, wheel_channels[leg]);
  }
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    add(acceleration[static_cast<int>(axis)], levels.acceleration, accelerometer_channels[axis]);
  }
  noisy.imu.linear_acceleration += acceleration;
  noisy.imu.raw_linear_acceleration += acceleration;
  for (int i = 0; i < servo_count; ++i) {
    const auto servo = static_cast<Servo>(i);
    add(noisy.servo[index(servo)].position, levels.joint_position, position_channel(servo));
    add(noisy.servo[index(servo)].velocity, levels.joint_velocity, velocity_channel(servo));
  }
  return noisy;
}

NoiseRealisation draw(const Recording& recording, const NoiseKey& key) {
  const auto column = [&](NoiseChannel channel) {
    std::vector<double> draws(recording.steps());
    fill_standard_normal(key, channel, 0, draws);
    return draws;
  };
  NoiseRealisation noise;
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    noise.knee_torque[leg] = column(knee_channels[leg]);
    noise.wheel_torque[leg] = column(wheel_channels[leg]);
  }
  const std::vector<double> x = column(NoiseChannel::accelerometer_x);
  const std::vector<double> y = column(NoiseChannel::accelerometer_y);
  const std::vector<double> z = column(NoiseChannel::accelerometer_z);
  noise.vertical_acceleration.resize(recording.steps());
  for (std::size_t step = 0; step < recording.steps(); ++step) {
    ImuReading unit_noise;
    unit_noise.orientation = recording.observation[step].imu.orientation;
    unit_noise.linear_acceleration = {x[step], y[step], z[step]};
    noise.vertical_acceleration[step] = vertical_acceleration(unit_noise);
  }
  return noise;
}

}  // namespace touchdown
