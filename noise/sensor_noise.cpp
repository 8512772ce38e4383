#include "noise/sensor_noise.hpp"

#include <array>

namespace touchdown::noise {

namespace {

constexpr std::array<models::Servo, models::wheel_count> knees = {models::Servo::left_knee,
                                                                  models::Servo::right_knee};
constexpr std::array<models::Servo, models::wheel_count> hips = {models::Servo::left_hip,
                                                                 models::Servo::right_hip};
constexpr std::array<NoiseChannel, models::wheel_count> hip_channels = {
    NoiseChannel::left_hip_torque, NoiseChannel::right_hip_torque};
constexpr std::array<NoiseChannel, models::wheel_count> knee_channels = {
    NoiseChannel::left_knee_torque, NoiseChannel::right_knee_torque};
constexpr std::array<NoiseChannel, models::wheel_count> wheel_channels = {
    NoiseChannel::left_wheel_torque, NoiseChannel::right_wheel_torque};
constexpr std::array<NoiseChannel, 3> accelerometer_channels = {
    NoiseChannel::accelerometer_x, NoiseChannel::accelerometer_y, NoiseChannel::accelerometer_z};

}  // namespace

models::Observation with_noise(const models::Observation& observation, const NoiseKey& key,
                               std::uint64_t step, const SensorNoise& levels) {
  models::Observation noisy = observation;
  const auto add = [&](double& value, double sigma, NoiseChannel channel) {
    if (sigma > 0.0) value += sigma * standard_normal(key, channel, step);
  };
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    add(noisy.servo[models::index(hips[leg])].torque, levels.hip_torque, hip_channels[leg]);
    add(noisy.servo[models::index(knees[leg])].torque, levels.knee_torque, knee_channels[leg]);
    add(noisy.servo[models::index(models::wheel_servos[leg])].torque, levels.wheel_torque,
        wheel_channels[leg]);
  }
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    add(acceleration[static_cast<int>(axis)], levels.acceleration, accelerometer_channels[axis]);
  }
  noisy.imu.linear_acceleration += acceleration;
  noisy.imu.raw_linear_acceleration += acceleration;
  for (int i = 0; i < models::servo_count; ++i) {
    const auto servo = static_cast<models::Servo>(i);
    add(noisy.servo[models::index(servo)].position, levels.joint_position, position_channel(servo));
    add(noisy.servo[models::index(servo)].velocity, levels.joint_velocity, velocity_channel(servo));
  }
  return noisy;
}

}  // namespace touchdown::noise
