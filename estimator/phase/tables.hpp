#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/numerics/axis.hpp"
#include "estimator/phase/model.hpp"

namespace touchdown {

/// Values per cell of the lookup tables: one per phase, padded to whole vector registers.
inline constexpr std::size_t phase_lanes = 12;

/// Log likelihoods by phase; the padding is zero.
using PhaseRow = std::array<float, phase_lanes>;

/// Between which two prepared noise levels a noise lies: `weight` in [0, 1] of the way from `level`
/// to the next one.
struct PhaseNoiseLevel {
  std::size_t level = 0;
  float weight = 0.0F;
};

/// Where noise `sigma` lies among densities of increasing `bandwidths`: linear in the logarithm of
/// the total bandwidth √(h² + σ²), h² being the first bandwidth's square less the first noise's.
PhaseNoiseLevel place_noise(double sigma, double kernel_width, std::span<const double> bandwidths);

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

  /// For noise at the knee or at the wheel: their levels are the same.
  [[nodiscard]] PhaseNoiseLevel place(double sigma) const;

 private:
  struct Table {
    AxisLookup knee;
    AxisLookup wheel;
    std::size_t row = 0;
    std::vector<float> cells;
  };
  std::vector<Table> tables_;
  std::vector<double> bandwidths_;
  double kernel_width_;
};

/// The acceleration densities, likewise.
class PhaseAccelerationTables {
 public:
  PhaseAccelerationTables(std::span<const PhaseAccelerationDensity> densities, double exponent);

  [[nodiscard]] PhaseRow operator()(double acceleration,
                                    const PhaseNoiseLevel& noise) const noexcept;

  [[nodiscard]] PhaseNoiseLevel place(double sigma) const;

 private:
  struct Table {
    AxisLookup axis;
    std::vector<float> cells;
  };
  std::vector<Table> tables_;
  std::vector<double> bandwidths_;
  double kernel_width_;
};

}  // namespace touchdown
