#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "estimator/force/leg_geometry.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// One run for a fit: the signals and the true contacts. The data must outlive the fit.
struct LabelledRun {
  std::span<const Signals> signals;  ///< one per step
  std::array<std::span<const std::uint8_t>, 2>
      contact;                  ///< per step: 1 in contact; left, right wheel
  double sample_rate = 1000.0;  ///< Hz
  std::size_t skip = 0;         ///< steps at the beginning that are not used
  /// The legs of its robot, for features of loads; empty: those of the fit's configuration.
  std::optional<LegGeometry> legs = {};
};

/// Throws InputError unless both wheels have one label per step.
void check_labels(const LabelledRun& run);

}  // namespace touchdown
