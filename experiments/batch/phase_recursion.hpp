#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimator/phase/recursion.hpp"
#include "experiments/batch/wide_vectors.hpp"

namespace touchdown::experiments {

/// Log likelihoods by phase at several noise levels, and their exponentials. Batch elements with
/// the same level share these.
class PhaseLikelihoods {
 public:
  explicit PhaseLikelihoods(std::size_t levels)
      : log_(levels * phase_count), exponential_(levels * phase_count) {}

  void set(std::size_t level, const PhaseRow& log_likelihood) noexcept;
  /// Computes the exponentials of all levels, relative to the largest of the level.
  void update() noexcept;

  /// By phase.
  [[nodiscard]] const float* logarithms(std::size_t level) const noexcept {
    return log_.data() + level * phase_count;
  }
  [[nodiscard]] const double* exponentials(std::size_t level) const noexcept {
    return exponential_.data() + level * phase_count;
  }

 private:
  std::vector<float> log_;
  std::vector<double> exponential_;
};

/// The recursion of `PhaseFilter` for a batch: α'_j ∝ e_j · Σ_i α_i A_ij. The evidence e of an
/// element is a product of two likelihoods. Most transitions from a phase have the same
/// probability, so the sum splits into a part that all phases share and a few terms.
class BatchedPhaseRecursion {
 public:
  /// `torque_level` and `acceleration_level` hold the level of each element's likelihoods.
  BatchedPhaseRecursion(const PhaseRecursion& one, std::span<const std::uint32_t> torque_level,
                        std::span<const std::uint32_t> acceleration_level);

  void update(const PhaseLikelihoods& torque, const PhaseLikelihoods& acceleration) noexcept;

  /// Probabilities of neighbouring elements, by phase, then element.
  struct alignas(sizeof(double) * batch_width) Block {
    std::array<std::array<double, batch_width>, phase_count> value;
  };
  /// The last block is filled with copies of the last element.
  [[nodiscard]] std::span<const Block> blocks() const noexcept { return alpha_; }

  /// A transition, and by how much it exceeds the least probable one from its phase.
  struct Transition {
    std::uint32_t from;
    double excess;
  };
  struct Transitions {
    explicit Transitions(const PhaseRecursion& one);

    PhaseProbabilities least{};     ///< the least probable one, by the phase before
    std::vector<Transition> other;  ///< by the phase after
    std::array<std::size_t, phase_count + 1> first{};  ///< of each phase's transitions
  };

 private:
  void update_one_by_one(std::size_t block, const PhaseLikelihoods& torque,
                         const PhaseLikelihoods& acceleration) noexcept;

  PhaseRecursion one_;
  Transitions transitions_;
  std::vector<std::uint32_t> torque_level_;  ///< by element, padded
  std::vector<std::uint32_t> acceleration_level_;
  std::vector<Block> alpha_;
  Block evidence_{};                                            ///< of the current block
  std::array<double, phase_count * batch_width> by_element_{};  ///< the same, transposed
};

}  // namespace touchdown::experiments
