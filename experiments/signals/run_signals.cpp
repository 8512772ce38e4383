#include "experiments/signals/run_signals.hpp"

#include <algorithm>
#include <cmath>

#include "recordings/signals_from.hpp"

namespace touchdown::experiments {

RunPointers pointers_to(const std::vector<RunSignals>& runs) {
  RunPointers pointers;
  pointers.reserve(runs.size());
  for (const RunSignals& run : runs) pointers.push_back(&run);
  return pointers;
}

RunSignals signals_of(const recordings::Recording& recording, const scoring::LabelConfig& labels,
                      const scoring::ScoringConfig& scoring, scoring::SampleUnit unit) {
  RunSignals run;
  run.info = recording.info;
  run.contact = scoring::contact_labels(recording, labels);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    run.normal_force[wheel].reserve(recording.steps());
    for (const models::GroundTruth& truth : recording.truth) {
      run.normal_force[wheel].push_back(truth.wheel_normal_force[wheel]);
    }
  }
  run.segments = {0};
  if (unit == scoring::SampleUnit::drop) {
    run.segments = scoring::drop_segments(
        scoring::both_wheels(run.contact),
        static_cast<std::size_t>(std::llround(scoring.hold_off / recording.period())));
  }
  run.signals.reserve(recording.steps());
  run.up_in_imu.reserve(recording.steps());
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const models::Observation& observation = recording.observation[k];
    run.signals.push_back(
        recordings::signals_from(observation, k > 0 ? &recording.action[k - 1] : nullptr));
    // The attitude reference system's z axis points down.
    run.up_in_imu.push_back(observation.imu.orientation.conjugate() * -Eigen::Vector3d::UnitZ());
  }
  return run;
}

NoiseRun noise_run(const RunSignals& run, const noise::NoiseKey& key) {
  const auto column = [&](noise::NoiseChannel channel) {
    std::vector<double> draws(run.steps());
    noise::fill_standard_normal(key, channel, 0, draws);
    return draws;
  };
  NoiseRun noise;
  noise.hip_torque = {column(noise::NoiseChannel::left_hip_torque),
                      column(noise::NoiseChannel::right_hip_torque)};
  noise.knee_torque = {column(noise::NoiseChannel::left_knee_torque),
                       column(noise::NoiseChannel::right_knee_torque)};
  noise.wheel_torque = {column(noise::NoiseChannel::left_wheel_torque),
                        column(noise::NoiseChannel::right_wheel_torque)};
  noise.acceleration = {column(noise::NoiseChannel::accelerometer_x),
                        column(noise::NoiseChannel::accelerometer_y),
                        column(noise::NoiseChannel::accelerometer_z)};
  noise.vertical_acceleration.resize(run.steps());
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Eigen::Vector3d draw(noise.acceleration[0][k], noise.acceleration[1][k],
                               noise.acceleration[2][k]);
    noise.vertical_acceleration[k] = run.up_in_imu[k].dot(draw);
  }
  for (int i = 0; i < models::servo_count; ++i) {
    const auto servo = static_cast<models::Servo>(i);
    const auto leg = static_cast<std::size_t>(i / 3);
    const auto joint = static_cast<std::size_t>(i % 3);
    noise.encoder[leg].position[joint] = column(noise::position_channel(servo));
    noise.encoder[leg].velocity[joint] = column(noise::velocity_channel(servo));
  }
  return noise;
}

void add_encoder_noise(Signals& signals, const NoiseRun& noise, const noise::SensorNoise& levels,
                       std::size_t step) {
  for (std::size_t i = 0; i < models::wheel_count; ++i) {
    LegSignals& leg = signals.leg[i];
    std::size_t joint = 0;
    for (JointSignals* servo : {&leg.hip, &leg.knee, &leg.wheel}) {
      servo->position += levels.joint_position * noise.encoder[i].position[joint][step];
      servo->velocity += levels.joint_velocity * noise.encoder[i].velocity[joint][step];
      ++joint;
    }
  }
}

}  // namespace touchdown::experiments
