#include "experiments/lanes/transition.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace touchdown::experiments {

TransitionLanes::TransitionLanes(const TransitionConfig& config, double sample_rate,
                                 std::span<const double> sigmas)
    : law_(config, sample_rate),
      clean_(config.window),
      noise_(config.window),
      magnitude_(config.median_of == SpectrumKind::magnitude),
      magnitudes_(clean_, config.nyquist),
      powers_(clean_, config.nyquist),
      sigmas_(sigmas.begin(), sigmas.end()),
      spectrum_(sigmas.size()),
      filtered_median_(sigmas.size()),
      stay_(sigmas.size()),
      takeoff_(sigmas.size()),
      landing_(sigmas.size()),
      fly_(sigmas.size()) {
  for (const double sigma : sigmas) {
    if (!(std::isfinite(sigma) && sigma >= 0.0)) {
      throw InputError("an accelerometer noise level must be finite and not negative (m/s²)");
    }
  }
}

void TransitionLanes::reset() noexcept {
  clean_.reset();
  noise_.reset();
  std::fill(filtered_median_.begin(), filtered_median_.end(), 0.0);
}

void TransitionLanes::update(double vertical_acceleration, double draw) noexcept {
  clean_.push(vertical_acceleration);
  noise_.push(draw);
  if (magnitude_) {
    magnitudes_.summarise(clean_, noise_, sigmas_, spectrum_);
  } else {
    powers_.summarise(clean_, noise_, sigmas_, spectrum_);
  }
  const std::size_t count = sigmas_.size();
  const SpectrumValues* const spectrum = spectrum_.data();
  double* const filtered_median = filtered_median_.data();
  double* const stay = stay_.data();
  double* const takeoff = takeoff_.data();
  double* const landing = landing_.data();
  double* const fly = fly_.data();
  const TransitionLaw law = law_;
  // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < count; ++i) {
    const Transition t = law.next(spectrum[i], filtered_median[i]);
    filtered_median[i] = t.filtered_median_frequency;
    stay[i] = t.contact_to_contact;
    takeoff[i] = t.contact_to_air;
    landing[i] = t.air_to_contact;
    fly[i] = t.air_to_air;
  }
}

}  // namespace touchdown::experiments
