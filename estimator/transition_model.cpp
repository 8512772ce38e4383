#include "estimator/transition_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {
namespace {

void check(bool good, const std::string& message) {
  if (!good) {
    throw InputError("transition model: " + message);
  }
}

}  // namespace

TransitionModel::TransitionModel(const TransitionConfig& config, double sample_rate)
    : config_(config),
      dft_(config.window),
      summary_(dft_, config.median_of, config.nyquist),
      bin_width_(sample_rate / config.window),
      power_scale_(config.power == PowerMeasure::mean_square ? 1.0 : config.window),
      memory_gain_(low_pass_gain(config.median_memory, 1.0 / sample_rate)) {
  check(std::isfinite(sample_rate) && sample_rate > 0.0, "the sample rate must be positive (Hz)");
  check(config.switch_sigmoid.slope > 0.0, "the switch sigmoid's slope must be positive");
  check(config.landing_sigmoid.slope > 0.0, "the landing sigmoid's slope must be positive");
  check(config.margin >= 0.0 && config.margin < 0.5, "the margin must be in [0, 0.5)");
  check(config.median_memory >= 0.0, "the median's memory must not be negative (s)");
  reset();
}

void TransitionModel::reset() noexcept {
  dft_.reset();
  transition_ = Transition{};
}

const Transition& TransitionModel::update(double vertical_acceleration) noexcept {
  dft_.push(vertical_acceleration);  // Eq. (9) and (10)
  const SpectrumValues spectrum = summary_(dft_);

  Transition& t = transition_;
  t.power = power_scale_ * spectrum.mean_square;
  t.p_switch = std::clamp(config_.switch_sigmoid(t.power), config_.margin,  // Eq. (11)
                          1.0 - config_.margin);

  t.median_frequency = bin_width_ * spectrum.median_bin;  // Eq. (12)
  if (config_.median_memory > 0.0) {
    const double input = t.median_frequency * t.p_switch;
    t.filtered_median_frequency += memory_gain_ * (input - t.filtered_median_frequency);
    t.filtered_median_frequency += memory_gain_ * (input - t.filtered_median_frequency);
  } else {
    t.filtered_median_frequency = t.median_frequency;
  }
  t.p_landing = std::clamp(config_.landing_sigmoid(t.filtered_median_frequency),  // Eq. (13)
                           config_.margin, 1.0 - config_.margin);

  fill_transition_matrix(t, config_.row_stochastic);
  return t;
}

}  // namespace touchdown
