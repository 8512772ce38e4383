#include "experiments/signals/run_signals.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/signals_from.hpp"
#include "noise/sensor_chain.hpp"

namespace touchdown::experiments {

namespace {

Eigen::Vector3d in_its_plane(const Eigen::Vector3d& link) { return {link.x(), 0.0, link.z()}; }

}  // namespace

odometry::WheeledBiped wheeled_biped(const models::RobotModel& robot) {
  const models::MjDataPtr data = models::at_zero(robot);
  const Eigen::Vector3d imu = robot.imu_position;
  odometry::WheeledBiped biped;
  biped.imu_in_base = models::imu_convention().toRotationMatrix();
  biped.wheel_radius = robot.wheel_radius;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    odometry::WheeledLeg& leg = biped.leg[side];
    std::array<Eigen::Vector3d, 3> anchor;
    for (std::size_t i = 0; i < anchor.size(); ++i) {
      const std::size_t servo = anchor.size() * side + i;
      if (!robot.has(servo)) {
        // A leg without a hip has one that never turns, and an upper link without length.
        anchor[i] = models::vector_at(data->xanchor, robot.joint[servo + 1]);
        leg.turn[i] = servo < anchor.size() ? -1.0 : 1.0;
        continue;
      }
      const int joint = robot.joint[servo];
      anchor[i] = models::vector_at(data->xanchor, joint);
      const double along = models::vector_at(data->xaxis, joint).y();
      leg.turn[i] = along > 0.0 ? 1.0 : -1.0;
      constexpr double parallel = 1e-3;
      if (std::abs(along) >= 1.0 - parallel) continue;
      throw InputError(fmt::format("{}: odometry: expected a joint '{}' about the base's y axis",
                                   robot.name, models::servo_names[servo]));
    }
    const Eigen::Vector3d tyre = models::vector_at(data->geom_xpos, robot.tyre_geom[side]);
    leg.hip = anchor[0] - imu;
    leg.hip.y() = (tyre - imu).y();
    leg.upper = in_its_plane(anchor[1] - anchor[0]);
    leg.lower = in_its_plane(tyre - anchor[1]);
  }
  return biped;
}

RunMotion motion_of(const logs::Recording& recording, const models::RobotModel& robot) {
  const Eigen::Vector3d imu = robot.imu_position;
  RunMotion motion{wheeled_biped(robot), {}, {}};
  motion.specific_force.reserve(recording.steps());
  motion.truth.reserve(recording.steps());
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    motion.specific_force.push_back(recording.observation[k].imu.raw_linear_acceleration);
    const models::GroundTruth& truth = recording.truth[k];
    motion.truth.push_back({recording.period() * static_cast<double>(k),
                            truth.base_position + truth.base_orientation * imu,
                            truth.base_orientation, truth.imu_linear_velocity});
  }
  return motion;
}

RunPointers pointers_to(const std::vector<RunSignals>& runs) {
  RunPointers pointers;
  pointers.reserve(runs.size());
  for (const RunSignals& run : runs) pointers.push_back(&run);
  return pointers;
}

RunSignals signals_of(const logs::Recording& recording, const scoring::LabelConfig& labels,
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
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const models::Observation& observation = recording.observation[k];
    run.signals.push_back(
        logs::signals_from(observation, k > 0 ? &recording.action[k - 1] : nullptr));
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
  noise.acceleration = {column(noise::NoiseChannel::accelerometer_x),
                        column(noise::NoiseChannel::accelerometer_y),
                        column(noise::NoiseChannel::accelerometer_z)};
  noise.vertical_acceleration.resize(run.steps());
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Eigen::Vector3d draw(noise.acceleration[0][k], noise.acceleration[1][k],
                               noise.acceleration[2][k]);
    noise.vertical_acceleration[k] = run.signals[k].up.dot(draw);
  }
  for (int i = 0; i < models::servo_count; ++i) {
    const auto servo = static_cast<models::Servo>(i);
    JointNoise& leg = noise.joint[static_cast<std::size_t>(i / 3)];
    const auto joint = static_cast<std::size_t>(i % 3);
    leg.torque[joint] = column(noise::torque_channel(servo));
    leg.position[joint] = column(noise::position_channel(servo));
    leg.velocity[joint] = column(noise::velocity_channel(servo));
  }
  return noise;
}

void add_encoder_noise(Signals& signals, const NoiseRun& noise, const noise::SensorNoise& levels,
                       std::size_t step) {
  for (std::size_t i = 0; i < models::wheel_count; ++i) {
    LegSignals& leg = signals.leg[i];
    std::size_t joint = 0;
    for (JointSignals* servo : {&leg.hip, &leg.knee, &leg.wheel}) {
      servo->position += levels.joint_position * noise.joint[i].position[joint][step];
      servo->velocity += levels.joint_velocity * noise.joint[i].velocity[joint][step];
      ++joint;
    }
  }
}

}  // namespace touchdown::experiments
