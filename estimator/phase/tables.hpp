#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/numerics/axis.hpp"
#include "estimator/phase/model.hpp"

namespace touchdown {

/// Values per cell of the lookup tables: one per phase, padded to whole vector registers.
inline constexpr std::size_t phase_simd_width = 12;

/// Log likelihoods by phase; the padding is zero.
using PhaseRow = std::array<float, phase_simd_width>;

/// Between which two prepared noise levels a noise lies: `weight` in [0, 1] of the way from `level`
/// to the next one.
struct PhaseNoiseLevel {
  std::size_t level = 0;
  float weight = 0.0F;
};

/// The noise levels that densities were prepared for.
struct PhaseNoiseLevels {
  std::vector<double> bandwidths;  ///< of the kernels, noise included; they increase
  double kernel_width = 0.0;       ///< h, without noise

  /// Where noise `sigma` lies: linear in the logarithm of the total bandwidth √(h² + σ²).
  [[nodiscard]] PhaseNoiseLevel place(double sigma) const;
};

/// The torque densities prepared for lookups: raised to an exponent, side by side for all phases,
/// bilinear in (knee, wheel) and linear between noise levels, all in the logarithm. Four pairs of
/// levels surround a pair of noises; the plane through three of them, both ends of the diagonal and
/// the corner on the pair's side, interpolates. Outside the grid the nearest edge counts.
class PhaseTorqueTables {
 public:
  PhaseTorqueTables(std::span<const PhaseTorqueDensity> densities, double exponent);

  /// Never fails; NaN counts as the lower end of its axis.
  [[nodiscard]] PhaseRow operator()(double knee, double wheel, const PhaseNoiseLevel& knee_noise,
                                    const PhaseNoiseLevel& wheel_noise) const noexcept;

  /// Of noise at the knee or at the wheel: their levels are the same.
  [[nodiscard]] const PhaseNoiseLevels& ladder() const noexcept { return ladder_; }

 private:
  struct Table {
    AxisLookup knee;
    AxisLookup wheel;
    std::size_t row = 0;
    std::vector<float> cells;
  };
  std::vector<Table> tables_;
  PhaseNoiseLevels ladder_;
};

/// The acceleration densities, likewise.
class PhaseAccelerationTables {
 public:
  PhaseAccelerationTables(std::span<const PhaseAccelerationDensity> densities, double exponent);

  [[nodiscard]] PhaseRow operator()(double acceleration,
                                    const PhaseNoiseLevel& noise) const noexcept;

  [[nodiscard]] const PhaseNoiseLevels& ladder() const noexcept { return ladder_; }

 private:
  struct Table {
    AxisLookup axis;
    std::vector<float> cells;
  };
  std::vector<Table> tables_;
  PhaseNoiseLevels ladder_;
};

}  // namespace touchdown
