#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/numerics/axis.hpp"
#include "estimator/phase/model.hpp"

namespace touchdown {

/// Log likelihoods by phase. As torques of one leg they are by density instead, with the two of the
/// single-wheel phases last (`legs_row`).
using PhaseRow = std::array<float, phase_count>;
static_assert(torque_density_count == phase_count, "cells of the tables have the size of a row");

/// The sum of the rows of both legs, by phase.
inline PhaseRow legs_row(const PhaseRow& left, const PhaseRow& right) noexcept {
  PhaseRow row;
  for (std::size_t k = 0; k < phase_count; ++k) row[k] = left[k] + right[k];
  row[index(Phase::left_only)] = left[supporting_leg] + right[airborne_leg];
  row[index(Phase::right_only)] = left[airborne_leg] + right[supporting_leg];
  return row;
}

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
  std::vector<Table> tables_;
  float exponent_;
  PhaseNoiseLevels noise_levels_;
};

/// Lookup tables of the acceleration densities, likewise, but copies of them with a value for each
/// of the two single-wheel phases.
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
