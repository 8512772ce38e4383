#include "estimator/bayes/transition_model.hpp"

#include "core/error.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {
namespace {

/// y += g (x − y) twice with the same x moves y by 1 − (1 − g)² of the way.
double gain_of_two_steps(double gain) { return gain * (2.0 - gain); }

}  // namespace

TransitionLaw::TransitionLaw(const TransitionConfig& config, double sample_rate)
    : switching_{config.switch_sigmoid.offset, 1.0 / config.switch_sigmoid.slope},
      landing_{config.landing_sigmoid.offset, 1.0 / config.landing_sigmoid.slope},
      margin_(config.margin),
      highest_(1.0 - config.margin),
      is_root_(config.power == PowerMeasure::root_mean_square),
      power_scale_(config.power == PowerMeasure::energy ? config.window : 1.0),
      bin_width_(sample_rate / config.window),
      memory_gain_(gain_of_two_steps(low_pass_gain(config.median_memory, 1.0 / sample_rate))),
      memory_(config.median_memory),
      repair_(config.row_stochastic ? 1.0 : 0.0) {
  if (!(std::isfinite(sample_rate) && sample_rate > 0.0)) {
    throw InputError("transition model: the sample rate must be positive (Hz)");
  }
  check_members(config);
}

TransitionModel::TransitionModel(const TransitionConfig& config, double sample_rate)
    : law_(config, sample_rate),
      dft_(config.window),
      summary_(dft_, config.median_of, config.nyquist) {}

void TransitionModel::reset() noexcept {
  dft_.reset();
  transition_ = Transition{};
}

const Transition& TransitionModel::update(double vertical_acceleration) noexcept {
  dft_.push(vertical_acceleration);  // Eq. (9) and (10)
  transition_ = law_.next(summary_(dft_), transition_.filtered_median_frequency);
  return transition_;
}

}  // namespace touchdown
