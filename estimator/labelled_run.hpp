#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "estimator/signals.hpp"

namespace touchdown {

/// One run for a fit: the signals and the true contacts. The data must outlive the fit.
struct LabelledRun {
  std::span<const Signals> signals;  ///< one per step
  std::array<std::span<const std::uint8_t>, 2>
      contact;                  ///< per step: 1 in contact; left, right wheel
  double sample_rate = 1000.0;  ///< Hz
  std::size_t skip = 0;         ///< steps at the beginning that are not used
};

/// Throws InputError unless both wheels have one label per step.
void check_labels(const LabelledRun& run);

}  // namespace touchdown
