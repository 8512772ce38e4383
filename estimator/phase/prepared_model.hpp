#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "estimator/numerics/axis.hpp"
#include "estimator/numerics/exponential.hpp"
#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/phase/config.hpp"
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

/// A value by phase for each of `filters` filters that run side by side.
template <int filters>
using PhaseValues = std::array<Eigen::Array<double, filters, 1>, phase_count>;

/// The step from one belief over phases to the next: α'_j ∝ e_j · Σ_i α_i A_ij. One filter and many
/// side by side compute the same bits, because no sum changes its order.
class PhaseRecursion {
 public:
  /// P(contact) = 0.5 for each wheel, for any and for both. Half of no contact is flight.
  static constexpr PhaseProbabilities prior = [] {
    PhaseProbabilities p{};
    p[index(Phase::rolling)] = 0.5;
    p[index(Phase::flight)] = 0.25;
    p[index(Phase::held)] = 0.25;
    return p;
  }();

  /// The model's transitions, `stride` of them in one step.
  PhaseRecursion(const PhaseModel& model, int stride);

  /// Updates α by the logarithm of e. With many filters each operation is vector code; with one,
  /// the loops over phases are.
  template <int filters>
  [[gnu::always_inline]] void predict_and_correct(
      PhaseValues<filters>& alpha, const PhaseValues<filters>& log_likelihood) const noexcept {
    using Values = Eigen::Array<double, filters, 1>;
    PhaseValues<filters> next;
    next.fill(Values::Zero());
    for (std::size_t i = 0; i < phase_count; ++i) {
      for (std::size_t j = 0; j < phase_count; ++j) next[j] += alpha[i] * transition_[i][j];
    }
    Values largest = log_likelihood[0];
    for (const Values& one : log_likelihood) largest = largest.max(one);
    Values sum = Values::Zero();
    for (std::size_t k = 0; k < phase_count; ++k) {
      Values evidence = log_likelihood[k] - largest;
      for (double& one : evidence) one = exponential(one);
      next[k] *= evidence;
      sum += next[k];
    }
    const Values scale = 1.0 / sum;
    for (std::size_t k = 0; k < phase_count; ++k) alpha[k] = next[k] * scale;
  }

 private:
  alignas(64) PhaseTransition transition_{};
};

/// P(left wheel in contact) and P(right wheel in contact) of filter `f`.
template <int filters>
std::array<double, 2> wheel_probabilities(const PhaseValues<filters>& alpha, int f = 0) noexcept {
  const double none = alpha[index(Phase::flight)][f] + alpha[index(Phase::held)][f];
  return {std::clamp(1.0 - (none + alpha[index(Phase::right_only)][f]), 0.0, 1.0),
          std::clamp(1.0 - (none + alpha[index(Phase::left_only)][f]), 0.0, 1.0)};
}

/// Whether a wheel is in contact now, if it was in contact before or not.
inline bool stays_or_returns(bool before, double p_contact,
                             const PhaseFilterConfig& config) noexcept {
  return before ? p_contact >= config.leave_below : p_contact > config.return_above;
}

/// A model in the form that filters run, one or many side by side. It holds transitions and
/// likelihoods at the filter's rate, fresh noise estimates, and the position of each of their
/// levels among the levels of the densities (one entry if the noise is known). Copies, and all
/// others that were prepared from the same model, share its densities.
struct PreparedPhaseModel {
  /// `shared` must be a model that `check_phase_model` accepts. Throws InputError for an invalid
  /// configuration, and for a sample rate that is not the model's divided by a whole number.
  PreparedPhaseModel(std::shared_ptr<const PhaseModel> shared, const PhaseFilterConfig& config);

  std::shared_ptr<const PhaseModel> model;
  PhaseRecursion recursion;
  PhaseTorqueTables torque;
  PhaseAccelerationTables acceleration;
  NoiseEstimate<2> knee_noise;
  NoiseEstimate<2> wheel_noise;
  NoiseEstimate<1> acceleration_noise;
  std::vector<PhaseNoiseLevel> knee_levels;
  std::vector<PhaseNoiseLevel> wheel_levels;
  std::vector<PhaseNoiseLevel> acceleration_levels;
};

}  // namespace touchdown
