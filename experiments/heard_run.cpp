#include "experiments/heard_run.hpp"

#include <cmath>

#include "experiments/oracle.hpp"
#include "recordings/signals_from.hpp"

namespace touchdown {

HeardRun hear(const Recording& recording, const LabelConfig& labels, const ScoringConfig& scoring,
              SampleUnit unit) {
  HeardRun run;
  run.info = recording.info;
  run.contact = contact_labels(recording, labels);
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    run.normal_force[wheel].reserve(recording.steps());
    for (const GroundTruth& truth : recording.truth) {
      run.normal_force[wheel].push_back(truth.wheel_normal_force[wheel]);
    }
  }
  run.pieces = {0};
  if (unit == SampleUnit::drop) {
    run.pieces =
        drop_pieces(both_wheels(run.contact),
                    static_cast<std::size_t>(std::llround(scoring.hold_off / recording.period())));
  }
  run.signals.reserve(recording.steps());
  run.up_in_imu.reserve(recording.steps());
  double command = 0.0;
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const Observation& observation = recording.observation[k];
    run.signals.push_back(signals_from(observation, command));
    // The attitude reference system's z axis points down.
    run.up_in_imu.push_back(observation.imu.orientation.conjugate() * -Eigen::Vector3d::UnitZ());
    command = ground_velocity_command(recording.action[k]);
  }
  return run;
}

UnitNoise unit_noise(const HeardRun& run, const NoiseKey& key) {
  const auto column = [&](NoiseChannel channel) {
    std::vector<double> draws(run.steps());
    fill_standard_normal(key, channel, 0, draws);
    return draws;
  };
  UnitNoise noise;
  noise.knee_torque = {column(NoiseChannel::left_knee_torque),
                       column(NoiseChannel::right_knee_torque)};
  noise.wheel_torque = {column(NoiseChannel::left_wheel_torque),
                        column(NoiseChannel::right_wheel_torque)};
  noise.acceleration = {column(NoiseChannel::accelerometer_x),
                        column(NoiseChannel::accelerometer_y),
                        column(NoiseChannel::accelerometer_z)};
  noise.vertical_acceleration.resize(run.steps());
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Eigen::Vector3d draw(noise.acceleration[0][k], noise.acceleration[1][k],
                               noise.acceleration[2][k]);
    noise.vertical_acceleration[k] = run.up_in_imu[k].dot(draw);
  }
  for (int i = 0; i < servo_count; ++i) {
    const auto servo = static_cast<Servo>(i);
    const auto leg = static_cast<std::size_t>(i / 3);
    const auto joint = static_cast<std::size_t>(i % 3);
    noise.encoder[leg].position[joint] = column(position_channel(servo));
    noise.encoder[leg].velocity[joint] = column(velocity_channel(servo));
  }
  return noise;
}

void add_encoder_noise(Signals& signals, const UnitNoise& noise, const NoiseLevels& levels,
                       std::size_t step) {
  for (std::size_t i = 0; i < wheel_count; ++i) {
    LegSignals& leg = signals.leg[i];
    std::size_t joint = 0;
    for (JointSignals* servo : {&leg.hip, &leg.knee, &leg.wheel}) {
      servo->position += levels.joint_position * noise.encoder[i].position[joint][step];
      servo->velocity += levels.joint_velocity * noise.encoder[i].velocity[joint][step];
      ++joint;
    }
  }
}

void begin(ContactEstimator& estimator, const HeardRun& run) {
  estimator.reset();
  if (auto* oracle = dynamic_cast<Oracle*>(&estimator)) oracle->tell(run.contact);
}

std::array<ContactSequence, wheel_count> decide(ContactEstimator& estimator, const HeardRun& run,
                                                const UnitNoise& noise, const NoiseLevels& levels) {
  std::array<ContactSequence, wheel_count> contact;
  contact.fill(ContactSequence(run.steps()));
  begin(estimator, run);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Belief& belief = estimator.update(noisy(run, noise, levels, k));
    contact[0][k] = std::uint8_t{belief.wheel[0].contact};
    contact[1][k] = std::uint8_t{belief.wheel[1].contact};
  }
  return contact;
}

Prediction predict(ContactEstimator& estimator, const HeardRun& run, const UnitNoise& noise,
                   const NoiseLevels& levels) {
  Prediction prediction;
  prediction.fill(
      {.contact = ContactSequence(run.steps()), .p_contact = std::vector<double>(run.steps())});
  begin(estimator, run);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const auto views = views_of(estimator.update(noisy(run, noise, levels, k)));
    for (std::size_t v = 0; v < view_count; ++v) {
      prediction[v].contact[k] = std::uint8_t{views[v].contact};
      prediction[v].p_contact[k] = views[v].p_contact;
    }
  }
  return prediction;
}

}  // namespace touchdown
