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

/// The position of a noise among the noise levels: `weight` in [0, 1] of the way from `level` to
/// the next one.
struct PhaseNoiseLevel {
  std::size_t level = 0;
  float weight = 0.0F;
};

/// The noise levels of the densities.
struct PhaseNoiseLevels {
  std::vector<double> bandwidths;  ///< of the kernels, noise included; they increase
  double kernel_width = 0.0;       ///< h, without noise

  /// The position of noise `sigma`: linear in the logarithm of the total bandwidth √(h² + σ²).
  [[nodiscard]] PhaseNoiseLevel place(double sigma) const;
};

/// Lookups in the torque densities, raised to an exponent. A row holds all phases. Lookups
/// are bilinear in (knee, wheel) and linear between noise levels, all in the logarithm. Four pairs
/// of levels surround a pair of noises. The plane through three of them interpolates: both ends of
/// the diagonal and the corner on the pair's side. Outside the grid the nearest edge counts. The
/// densities, tens of megabytes, are not copied: they must outlive the tables.
class PhaseTorqueTables {
 public:
  PhaseTorqueTables(std::span<const PhaseTorqueDensity> densities, double exponent);

  /// Never fails; NaN counts as the lower end of its axis.
  [[nodiscard]] PhaseRow operator()(double knee, double wheel, const PhaseNoiseLevel& knee_noise,
                                    const PhaseNoiseLevel& wheel_noise) const noexcept;

  /// The levels of noise at the knee, which equal those at the wheel.
  [[nodiscard]] const PhaseNoiseLevels& noise_levels() const noexcept { return noise_levels_; }

 private:
  struct Table {
    AxisLookup knee;
    AxisLookup wheel;
    std::size_t row = 0;
    const float* cells = nullptr;
  };
  static_assert(torque_density_count == phase_simd_width, "rows are those of the densities");

  std::vector<Table> tables_;
  float exponent_;
  PhaseNoiseLevels noise_levels_;
};

/// Lookup tables of the acceleration densities, likewise, but padded copies of them.
class PhaseAccelerationTables {
 public:
  PhaseAccelerationTables(std::span<const PhaseAccelerationDensity> densities, double exponent);

  [[nodiscard]] PhaseRow operator()(double acceleration,
                                    const PhaseNoiseLevel& noise) const noexcept;

  [[nodiscard]] const PhaseNoiseLevels& noise_levels() const noexcept { return noise_levels_; }

 private:
  struct Table {
    AxisLookup axis;
    std::vector<float> cells;
  };
  std::vector<Table> tables_;
  PhaseNoiseLevels noise_levels_;
};

}  // namespace touchdown
