#include "estimator/transition_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace touchdown {

TransitionLanes::TransitionLanes(const TransitionConfig& config, double sample_rate,
                                 std::span<const double> sigmas)
    : law_(config, sample_rate),
      clean_(config.window),
      noise_(config.window),
      summary_(clean_, config.median_of, config.nyquist),
      sigmas_(sigmas.begin(), sigmas.end()),
      spectra_(sigmas.size()),
      transitions_(sigmas.size()) {
  for (const double sigma : sigmas) {
    if (!(std::isfinite(sigma) && sigma >= 0.0)) {
      throw InputError("an accelerometer noise level must be finite and not negative (m/s²)");
    }
  }
}

void TransitionLanes::reset() noexcept {
  clean_.reset();
  noise_.reset();
  std::fill(transitions_.begin(), transitions_.end(), Transition{});
}

void TransitionLanes::update(double vertical_acceleration, double draw) noexcept {
  clean_.push(vertical_acceleration);
  noise_.push(draw);
  for (std::size_t i = 0; i < sigmas_.size(); ++i) {
    spectra_[i] = summary_(clean_, noise_, sigmas_[i]);
  }
  for (std::size_t i = 0; i < sigmas_.size(); ++i) {
    law_.apply(spectra_[i], transitions_[i]);
  }
}

}  // namespace touchdown
