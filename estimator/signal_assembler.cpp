#include "estimator/signal_assembler.hpp"

#include <bit>
#include <cmath>

#include <Eigen/Geometry>

#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

constexpr int steps_for_rate = 200;  // between two checks of the rate

bool is_whole(const JointSignals& joint) noexcept {
  return std::isfinite(joint.position) && std::isfinite(joint.velocity) &&
         std::isfinite(joint.torque);
}

bool is_same(const JointSignals& a, const JointSignals& b) noexcept {
  return a.position == b.position && a.velocity == b.velocity && a.torque == b.torque;
}

/// Left hip, knee, wheel, then right.
JointSignals& joint_of(Signals& signals, std::size_t i) noexcept {
  LegSignals& leg = signals.leg[i / 3];
  return i % 3 == 0 ? leg.hip : i % 3 == 1 ? leg.knee : leg.wheel;
}

}  // namespace

std::string_view to_text(RecordFault fault) noexcept {
  static constexpr std::array<std::string_view, record_fault_count> texts = {
      "joint missing", "joint stale", "orientation missing", "upside down", "acceleration missing",
      "clock missing", "clock back",  "clock gap",           "clock rate",  "signal stopped"};
  const auto index = static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(fault)));
  return index < texts.size() ? texts[index] : "";
}

SignalAssembler::SignalAssembler(const AssemblyConfig& config)
    : config_(config), stopped_(config.stale_after) {
  check_assembly_config(config);
  gravity_gain_ = exact_low_pass_gain(config.gravity_memory, config.sample_rate);
}

void SignalAssembler::reset() noexcept {
  faults_ = {};
  counts_ = {};
  started_ = false;
  steps_time_ = 0.0;
  steps_ = 0;
  is_rate_wrong_ = false;
  upward_ = 0.0;
  stopped_.reset();
  repeated_ = {};
  if (config_.closed_legs) config_.closed_legs->reset();
}

std::uint64_t SignalAssembler::count(RecordFault fault) const noexcept {
  return counts_[static_cast<std::size_t>(std::countr_zero(static_cast<std::uint32_t>(fault)))];
}

const Signals& SignalAssembler::assemble(const RobotRecord& record) noexcept {
  const ImuSignals imu = imu_of(record, config_);
  signals_ = signals_of(record, config_, imu);
  if (config_.closed_legs) take_motors(imu);
  faults_ = {};
  watch_clock();
  // Removing gravity moves an acceleration that stopped: the chip's own one is compared.
  Eigen::Vector3d measured = imu.proper_acceleration;
  if (measured.hasNaN()) measured = signals_.linear_acceleration;
  measured.swap(signals_.linear_acceleration);
  const std::uint32_t stopped = stopped_.update(signals_);
  measured.swap(signals_.linear_acceleration);
  if (stopped != 0) faults_.add(RecordFault::signal_stopped);
  watch_joints();
  watch_imu(imu);
  constexpr std::uint32_t acceleration = 7U << 18U;
  if ((stopped & acceleration) != 0) {
    signals_.linear_acceleration.setConstant(not_reported);
    signals_.vertical_acceleration = not_reported;
  }
  started_ = true;
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += (faults_.bits >> i) & 1U;
  return signals_;
}

void SignalAssembler::take_motors(const ImuSignals& imu) noexcept {
  Eigen::Vector3d proper = imu.proper_acceleration;
  if (proper.hasNaN()) {
    const std::array<double, 4>& q = imu.orientation;
    proper = signals_.linear_acceleration - Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() *
                                                Eigen::Vector3d(0.0, 0.0, gravity_at_rest);
  }
  config_.closed_legs->convert(signals_.leg, proper);
  for (LegTargets& target : signals_.target) target.hip = target.knee = {};
}

void SignalAssembler::watch_clock() noexcept {
  if (!std::isfinite(signals_.time)) {
    faults_.add(RecordFault::clock_missing);
    return;
  }
  const double step = started_ ? signals_.time - time_ : 1.0 / config_.sample_rate;
  time_ = signals_.time;
  if (step < 0.0) {
    faults_.add(RecordFault::clock_back);
  } else if (step > config_.maximum_gap) {
    faults_.add(RecordFault::clock_gap);
  } else {
    steps_time_ += step;
    ++steps_;
  }
  if (steps_ == steps_for_rate) {
    const double share = steps_time_ * config_.sample_rate / steps_for_rate;
    is_rate_wrong_ = !(std::abs(share - 1.0) <= config_.rate_tolerance);
    steps_time_ = 0.0;
    steps_ = 0;
  }
  if (is_rate_wrong_) faults_.add(RecordFault::clock_rate);
}

void SignalAssembler::watch_joints() noexcept {
  for (std::size_t i = 0; i < last_.size(); ++i) {
    JointSignals& joint = joint_of(signals_, i);
    if (!is_whole(joint)) faults_.add(RecordFault::joint_missing);
    const bool repeats = started_ && is_same(joint, last_[i]);
    repeated_[i] = repeats ? repeated_[i] + 1.0 / config_.sample_rate : 0.0;
    last_[i] = joint;
    if (config_.stale_after > 0.0 && repeated_[i] >= config_.stale_after) {
      faults_.add(RecordFault::joint_stale);
      joint.torque = not_reported;
    }
  }
}

void SignalAssembler::watch_imu(const ImuSignals& imu) noexcept {
  if (signals_.linear_acceleration.hasNaN()) faults_.add(RecordFault::acceleration_missing);
  // Without the chip's own measurement, gravity is added back to the acceleration that the robot
  // took it out of by the same orientation.
  const double reported = upward(imu.orientation, imu.proper_acceleration);
  const double proper =
      std::isfinite(reported) ? reported : signals_.vertical_acceleration + gravity_at_rest;
  if (std::isnan(upward(imu.orientation, Eigen::Vector3d::Zero()))) {
    faults_.add(RecordFault::orientation_missing);
  }
  if (std::isfinite(proper)) upward_ += gravity_gain_ * (proper - upward_);
  // Nothing accelerates a robot downwards beyond g for that long: the orientation must be wrong.
  if (upward_ < -0.5 * gravity_at_rest) {
    faults_.add(RecordFault::upside_down);
    signals_.vertical_acceleration = not_reported;
  }
}

}  // namespace touchdown
