#include "estimator/neural/estimator.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace touchdown {
namespace {

/// Whether all inputs are finite but the vertical acceleration, which the guard checks.
bool finite(const Signals& s) {
  double sum = s.linear_acceleration.sum() + s.angular_velocity.sum() + s.ground_velocity_command;
  for (const LegSignals& leg : s.leg) {
    for (const JointSignals& joint : {leg.hip, leg.knee, leg.wheel}) {
      sum += joint.position + joint.velocity;
    }
  }
  return std::isfinite(static_cast<float>(sum));
}

}  // namespace

int neural_stride(double sample_rate, double period) {
  const double samples = sample_rate * period;
  const double whole = std::round(samples);
  constexpr double most = 1e6;
  if (!(whole >= 1.0 && whole <= most && std::abs(samples - whole) <= 1e-6 * whole)) {
    throw InputError("neural estimator: its step of " + std::to_string(period) +
                     " s is not a whole number of samples at " + std::to_string(sample_rate) +
                     " Hz");
  }
  return static_cast<int>(whole);
}

NeuralEstimator::NeuralEstimator(std::shared_ptr<const NeuralNetwork> network,
                                 const NeuralEstimatorConfig& config)
    : config_(config),
      guard_(config.guard, config.sample_rate),
      forward_(std::move(network)),
      sampler_(neural_stride(config.sample_rate, forward_.network().period)),
      input_(neural_input_count) {
  check_members(config);
  reset();
}

void NeuralEstimator::reset() noexcept {
  guard_.reset();
  sampler_.reset();
  forward_.reset();
  velocity_.setZero();
  belief_ = Belief{};
  apply_threshold(0.5);
}

const Belief& NeuralEstimator::estimate(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  belief_.status = verdict.status;
  if (verdict.restart) {
    sampler_.reset();
    forward_.reset();
  }
  bool usable = verdict.acceleration_good;
  if (usable && !finite(signals)) {
    usable = false;
    belief_.status = SignalStatus::invalid;
  }
  if (verdict.restart || !usable) {
    apply_threshold(guard_.relaxed(belief_.wheel[0].p_contact, verdict.elapsed));
  }
  if (!usable) {
    sampler_.skip();
  } else if (sampler_.add(signals)) {
    step();
  }
  return belief_;
}

void NeuralEstimator::step() noexcept {
  input_ = sampler_.input();
  const auto& output = forward_.step(input_);
  velocity_ = output.tail<3>().cast<double>();
  apply_threshold(1.0 / (1.0 + std::exp(-static_cast<double>(output[0]))));
}

void NeuralEstimator::apply_threshold(double p_contact) noexcept {
  for (WheelBelief& wheel : belief_.wheel) wheel = {p_contact, p_contact >= config_.threshold};
  belief_.p_any_wheel = p_contact;
  belief_.p_both_wheels = p_contact;
}

}  // namespace touchdown
