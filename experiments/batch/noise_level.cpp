#include "experiments/batch/noise_level.hpp"

#include <cmath>

#include "core/error.hpp"
#include "experiments/batch/wide_vectors.hpp"

namespace touchdown::experiments {
namespace {

TOUCHDOWN_WIDE_VECTORS
void add_scaled(double clean, double draw, const double* sigma, double* noisy,
                std::size_t count) noexcept {
  // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < count; ++i) noisy[i] = clean + sigma[i] * draw;
}

}  // namespace

void check_levels(std::span<const BatchNoise> levels) {
  if (levels.empty()) throw InputError("a sweep needs at least one noise level");
  for (const BatchNoise& level : levels) {
    for (const double sigma : {level.knee_torque, level.wheel_torque, level.acceleration}) {
      if (!(std::isfinite(sigma) && sigma >= 0.0)) {
        throw InputError("a noise level must be finite and not negative");
      }
    }
  }
}

void add_noise(double clean, double draw, std::span<const double> sigma,
               std::span<double> noisy) noexcept {
  add_scaled(clean, draw, sigma.data(), noisy.data(), noisy.size());
}

}  // namespace touchdown::experiments
