#include "estimator/c_handle.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/error.hpp"
#include "estimator/numerics/number_text.hpp"

namespace touchdown {

namespace {

static_assert(static_cast<unsigned>(RecordFault::signal_stopped) == TOUCHDOWN_SIGNAL_STOPPED &&
              static_cast<unsigned>(RecordFault::upside_down) == TOUCHDOWN_UPSIDE_DOWN &&
              static_cast<int>(SignalStatus::frozen) == TOUCHDOWN_FROZEN &&
              static_cast<int>(SignalStatus::degraded) == TOUCHDOWN_DEGRADED);

Eigen::Vector3d vector(const double (&values)[3]) noexcept {  // NOLINT: C's arrays
  return {values[0], values[1], values[2]};
}

touchdown_belief in_c(const Belief& belief, RecordFaults faults) noexcept {
  return {{belief.wheel[0].p_contact, belief.wheel[1].p_contact},
          {belief.wheel[0].contact ? 1 : 0, belief.wheel[1].contact ? 1 : 0},
          belief.p_any_wheel,
          belief.p_both_wheels,
          static_cast<int>(belief.status),
          faults.bits,
          static_cast<int>(belief.unusable),
          {belief.wheel[0].load.force, belief.wheel[1].load.force},
          {belief.wheel[0].load.deviation, belief.wheel[1].load.deviation}};
}

/// The conventions of a C program, at the rate of its records.
AssemblyConfig in_cpp(const touchdown_conventions& theirs, double sample_rate) noexcept {
  AssemblyConfig config{.sample_rate = sample_rate};
  for (std::size_t i = 0; i < config.joints.size(); ++i) {
    const touchdown_joint_source& joint = theirs.joint[i];
    config.joints.at(i) = {joint.index,          joint.sign,           joint.zero,
                           joint.position_scale, joint.velocity_scale, joint.torque_scale};
  }
  config.units = {.time = theirs.time_unit,
                  .position = theirs.position_unit,
                  .velocity = theirs.velocity_unit,
                  .torque = theirs.torque_unit,
                  .angular_velocity = theirs.angular_velocity_unit,
                  .linear_acceleration = theirs.linear_acceleration_unit,
                  .kp = theirs.kp_unit,
                  .kd = theirs.kd_unit};
  config.acceleration = theirs.uses_proper_acceleration != 0 ? AccelerationSource::proper
                                                             : AccelerationSource::without_gravity;
  config.reference_is_z_up = theirs.reference_is_z_up != 0;
  for (Eigen::Index row = 0; row < 3; ++row)
    config.axes.row(row) = vector(theirs.imu_axes[row]).transpose();
  return config;
}

std::string described(const ModelMetadata& metadata) {
  return metadata.estimator + ", " + text_of(metadata.sample_rate) + " Hz, robot " +
         (metadata.robot.empty() ? "unknown" : metadata.robot) + ", fingerprint " +
         (metadata.fingerprint.empty() ? "unknown" : metadata.fingerprint);
}

}  // namespace

touchdown_estimator* new_handle(const Model& model, const ModelUse& use) {
  const ModelMetadata metadata = metadata_for(model, use);
  const double rate = use.sample_rate > 0.0 ? use.sample_rate : metadata.sample_rate;
  auto handle = std::make_unique<touchdown_estimator>(touchdown_estimator{
      described(metadata), make_estimator(model, use), SignalAssembler({.sample_rate = rate})});
  return handle.release();
}

touchdown_estimator* new_handle(const ModelArrays& arrays, const ModelUse& use) {
  return new_handle(model_of(arrays), use);
}

ModelUse use_of(const touchdown_use* use) {
  if (use == nullptr) return {};
  return {.estimator = use->estimator == nullptr ? "" : use->estimator,
          .sample_rate = use->sample_rate,
          .robot = use->robot == nullptr ? "" : use->robot};
}

void write_error(const char* message, char* error, std::size_t error_size) noexcept {
  if (error == nullptr || error_size == 0) return;
  const std::size_t size = std::min(std::strlen(message), error_size - 1);
  std::memcpy(error, message, size);
  error[size] = '\0';
}

}  // namespace touchdown

using namespace touchdown;  // NOLINT: C functions cannot be in a namespace

touchdown_record touchdown_empty_record(void) {
  constexpr double n = not_reported;
  constexpr touchdown_joint joint = {n, n, n};
  return {
      n,  {joint, joint, joint, joint, joint, joint}, {n, n, n, n}, {n, n, n}, {n, n, n}, {n, n, n},
      0.0};
}

touchdown_conventions touchdown_upkie_conventions(void) {
  touchdown_conventions upkie = {};
  for (std::size_t i = 0; i < 6; ++i) upkie.joint[i] = {i, 1.0, 0.0, 1.0, 1.0, 1.0};
  for (double* const unit :
       {&upkie.time_unit, &upkie.position_unit, &upkie.velocity_unit, &upkie.torque_unit,
        &upkie.angular_velocity_unit, &upkie.linear_acceleration_unit, &upkie.kp_unit,
        &upkie.kd_unit, &upkie.imu_axes[0][0], &upkie.imu_axes[1][1], &upkie.imu_axes[2][2]}) {
    *unit = 1.0;
  }
  return upkie;
}

int touchdown_set_conventions(touchdown_estimator* estimator,
                              const touchdown_conventions* conventions, char* error,
                              size_t error_size) {
  const auto set = [&]() -> touchdown_estimator* {
    if (estimator == nullptr || conventions == nullptr) {
      throw InputError("touchdown_set_conventions: expected an estimator and conventions");
    }
    const double sample_rate = estimator->assembler.config().sample_rate;
    estimator->assembler = SignalAssembler(in_cpp(*conventions, sample_rate));
    estimator->estimator->reset();
    return estimator;
  };
  return handle_or_error(set, error, error_size) == nullptr ? 0 : 1;
}

touchdown_belief touchdown_update(touchdown_estimator* estimator, const touchdown_record* record) {
  return touchdown_update_with_targets(estimator, record, nullptr);
}

touchdown_belief touchdown_update_with_targets(touchdown_estimator* estimator,
                                               const touchdown_record* record,
                                               const touchdown_target* targets) {
  if (estimator == nullptr || record == nullptr) {
    Belief none;
    none.status = SignalStatus::invalid;
    return in_c(none, {});
  }
  std::array<JointSignals, 6> joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const touchdown_joint& joint = record->joint[i];
    joints[i] = {joint.position, joint.velocity, joint.torque};
  }
  std::array<JointTarget, 6> commands;
  for (std::size_t i = 0; targets != nullptr && i < commands.size(); ++i) {
    const touchdown_target& target = targets[i];
    commands[i] = {target.position, target.velocity, target.feedforward_torque, target.kp,
                   target.kd};
  }
  const double(&q)[4] = record->orientation;  // NOLINT: C's arrays
  const Signals& signals =
      estimator->assembler.assemble({.time = record->time,
                                     .joints = joints,
                                     .orientation = {q[0], q[1], q[2], q[3]},
                                     .angular_velocity = vector(record->angular_velocity),
                                     .linear_acceleration = vector(record->linear_acceleration),
                                     .proper_acceleration = vector(record->proper_acceleration),
                                     .ground_velocity_command = record->ground_velocity_command,
                                     .targets = commands});
  return in_c(estimator->estimator->update(signals), estimator->assembler.faults());
}

void touchdown_reset(touchdown_estimator* estimator) {
  if (estimator == nullptr) return;
  estimator->estimator->reset();
  estimator->assembler.reset();
}

void touchdown_destroy(touchdown_estimator* estimator) { delete estimator; }

const char* touchdown_model_text(const touchdown_estimator* estimator) {
  return estimator == nullptr ? "" : estimator->text.c_str();
}

const char* touchdown_status_text(int status) {
  return to_text(static_cast<SignalStatus>(status)).data();  // a literal, so zero-terminated
}

const char* touchdown_signal_text(int signal) {
  const std::string_view text = to_text(static_cast<SignalIndex>(signal));
  return text.empty() ? "" : text.data();
}

const char* touchdown_version() { return TOUCHDOWN_VERSION; }
