#pragma once

#include "estimator/spectrum/median.hpp"
#include "estimator/spectrum/sliding_dft.hpp"

namespace touchdown::experiments {

/// A real-valued bin of the spectrum of the window (clean + sigma · noise).
struct MixedRealBin {
  double clean = 0.0;
  double noise = 0.0;

  [[nodiscard]] double at(double sigma) const noexcept { return clean + sigma * noise; }
};

/// Σ |X + σZ|² over rows of bins, per SIMD lane, as the coefficients of a parabola in σ:
/// |X|² + σ · 2 Re(X·Z̄) + σ² |Z|².
struct MixedEnergy {
  SpectrumRow constant = SpectrumRow::Zero();
  SpectrumRow linear = SpectrumRow::Zero();
  SpectrumRow square = SpectrumRow::Zero();

  void add_row(const SlidingDft& clean, const SlidingDft& noise, int row) noexcept {
    const int first = row * SlidingDft::lanes;
    const ConstSpectrumRowMap x(clean.reals().data() + first);
    const ConstSpectrumRowMap y(clean.imaginaries().data() + first);
    const ConstSpectrumRowMap x_noise(noise.reals().data() + first);
    const ConstSpectrumRowMap y_noise(noise.imaginaries().data() + first);
    constant += x.square() + y.square();
    linear += 2.0 * (x * x_noise + y * y_noise);
    square += x_noise.square() + y_noise.square();
  }
};

}  // namespace touchdown::experiments
