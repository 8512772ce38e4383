#pragma once

#include <algorithm>
#include <array>

#include "estimator/numerics/exponential.hpp"
#include "estimator/phase/model.hpp"
#include "estimator/phase/tables.hpp"

namespace touchdown {

/// The step from one belief over phases to the next: α'_j ∝ e_j · Σ_i α_i A_ij. Arrays are padded
/// with zeros to whole vector registers.
class PhaseRecursion {
 public:
  using Lanes = std::array<double, phase_simd_width>;

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

  /// Log likelihoods by phase, from the rows of both legs and of the acceleration.
  static Lanes evidence(const PhaseRow& left, const PhaseRow& right,
                        const PhaseRow& vertical) noexcept {
    // The padding's log likelihood: e^−700 of the largest.
    constexpr double impossible = -1e9;
    Lanes log_likelihood;
    for (std::size_t k = 0; k < phase_simd_width; ++k) {
      log_likelihood[k] = static_cast<double>(left[k] + right[k] + vertical[k]);
    }
    const float single = vertical[acceleration_density_count - 1];
    log_likelihood[index(Phase::left_only)] =
        static_cast<double>(left[supporting_leg] + right[airborne_leg] + single);
    log_likelihood[index(Phase::right_only)] =
        static_cast<double>(left[airborne_leg] + right[supporting_leg] + single);
    for (std::size_t k = phase_count; k < phase_simd_width; ++k) log_likelihood[k] = impossible;
    return log_likelihood;
  }

  void predict_and_correct(Lanes& alpha, const Lanes& log_likelihood) const noexcept {
    Lanes predicted{};
    for (std::size_t i = 0; i < phase_count; ++i) {
      for (std::size_t j = 0; j < phase_simd_width; ++j)
        predicted[j] += alpha[i] * transition_[i][j];
    }
    double largest = log_likelihood[0];
    for (std::size_t k = 1; k < phase_simd_width; ++k)
      largest = std::max(largest, log_likelihood[k]);
    double sum = 0.0;
    for (std::size_t k = 0; k < phase_simd_width; ++k) {
      predicted[k] *= exponential(log_likelihood[k] - largest);
      sum += predicted[k];
    }
    const double scale = 1.0 / sum;
    for (std::size_t k = 0; k < phase_simd_width; ++k) alpha[k] = predicted[k] * scale;
  }

  /// P(phase `to` at the next step | phase `from`).
  [[nodiscard]] double transition(std::size_t from, std::size_t to) const noexcept {
    return transition_[from][to];
  }

  /// P(left wheel in contact), P(right wheel in contact).
  static std::array<double, 2> wheels(const Lanes& alpha) noexcept {
    const double none = alpha[index(Phase::flight)] + alpha[index(Phase::held)];
    return {std::clamp(1.0 - (none + alpha[index(Phase::right_only)]), 0.0, 1.0),
            std::clamp(1.0 - (none + alpha[index(Phase::left_only)]), 0.0, 1.0)};
  }

 private:
  alignas(64) std::array<Lanes, phase_count> transition_{};  // from row to column
};

/// The number of the model's steps per step of a filter at `filter_rate` (Hz). Throws InputError
/// unless it is a whole number.
int phase_stride(double model_rate, double filter_rate);

/// The exponent of likelihoods at that stride. Sparser samples count more each, but never more than
/// independent samples.
double phase_exponent(double exponent, int stride);

}  // namespace touchdown
