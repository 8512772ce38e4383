#include "estimator/signal_guard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace touchdown {
SignalGuard::SignalGuard(const SignalGuardConfig& config, double sample_rate)
    : config_(config), time_step_(1.0 / sample_rate), acceleration_(config, sample_rate) {
  if (!(std::isfinite(sample_rate) && sample_rate > 0.0)) {
    throw InputError("signal guard: the sample rate must be positive (Hz)");
  }
  check_members(config);
}

void SignalGuard::reset() noexcept {
  started_ = false;
  acceleration_.reset();
}

SignalGuard::Verdict SignalGuard::check(double time, double vertical_acceleration) noexcept {
  Verdict verdict;
  verdict.elapsed = time_step_;
  if (!std::isfinite(time)) {
    verdict.status = SignalStatus::invalid;
    verdict.acceleration_good = false;
    return verdict;
  }
  if (started_) {
    verdict.elapsed = time - time_;
    if (verdict.elapsed < 0.0) verdict.elapsed = std::numeric_limits<double>::infinity();
    if (verdict.elapsed > config_.maximum_gap) {
      verdict.status = SignalStatus::gap;
      verdict.restart = true;
    }
  }
  time_ = time;
  started_ = true;
  // Written so that NaN fails.
  if (!(std::abs(vertical_acceleration) <= config_.largest_acceleration)) {
    verdict.status = SignalStatus::invalid;
    verdict.acceleration_good = false;
    return verdict;
  }
  if (acceleration_.update({vertical_acceleration})) {
    verdict.status = SignalStatus::frozen;
    verdict.acceleration_good = false;
    verdict.restart = true;
  }
  return verdict;
}

double SignalGuard::relaxed(double p_contact, double elapsed) const noexcept {
  const double p_switch = 0.5 * (1.0 - std::exp(-elapsed / config_.relaxation));
  return (1.0 - p_switch) * p_contact + p_switch * (1.0 - p_contact);
}

}  // namespace touchdown
