#include "estimator/phase/config.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"

namespace touchdown {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw InputError(std::string("phase filter: ") + what);
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

bool is_increasing(const std::vector<double>& levels) {
  return !levels.empty() && levels.front() >= 0.0 && std::isfinite(levels.back()) &&
         std::adjacent_find(levels.begin(), levels.end(),
                            [](double a, double b) { return !(a < b); }) == levels.end();
}

}  // namespace

void check_phase_fit_config(const PhaseFitConfig& config) {
  check_phase_labels(config.labels);
  require(positive(config.torque_bandwidth) && positive(config.acceleration_bandwidth),
          "bandwidths must be positive");
  require(is_increasing(config.torque_noise) && is_increasing(config.acceleration_noise),
          "noise levels must increase from zero or more");
  require(config.grid_step > 0.0 && config.grid_step <= 2.0, "grid_step must be in (0, 2]");
  require(positive(config.largest_knee_step) && positive(config.largest_wheel_step),
          "largest grid steps must be positive");
  require(config.contamination > 0.0 && config.contamination <= 1.0,
          "contamination must be in (0, 1]");
  require(positive(config.knee_range) && positive(config.wheel_range) &&
              positive(config.acceleration_range),
          "ranges must be positive");
  require(positive(config.pseudo_count), "pseudo_count must be positive");
}

void check_phase_filter_config(const PhaseFilterConfig& config) {
  require(positive(config.sample_rate), "the sample rate must be positive (Hz)");
  require(positive(config.torque_exponent) && positive(config.acceleration_exponent),
          "exponents must be positive");
  require(config.leave_below >= 0.0 && config.leave_below <= config.return_above &&
              config.return_above <= 1.0,
          "expected 0 ≤ leave_below ≤ return_above ≤ 1");
  require(positive(config.noise_floor.knee_torque) && positive(config.noise_floor.wheel_torque) &&
              positive(config.noise_floor.acceleration),
          "noise floors must be positive");
  require(config.noise_gain > 0.0 && config.noise_gain < 1.0, "noise_gain must be in (0, 1)");
  require(config.noise_warm_up >= 0.0 && std::isfinite(config.noise_warm_up),
          "noise_warm_up must not be negative (s)");
  if (config.noise) {
    for (const double sigma :
         {config.noise->knee_torque, config.noise->wheel_torque, config.noise->acceleration}) {
      require(sigma >= 0.0 && std::isfinite(sigma), "known noise must not be negative");
    }
  }
}

}  // namespace touchdown
