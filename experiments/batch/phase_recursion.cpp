#include "experiments/batch/phase_recursion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "estimator/numerics/exponential.hpp"

namespace touchdown::experiments {
namespace {

using Block = BatchedPhaseRecursion::Block;
using Values [[gnu::vector_size(sizeof(double) * batch_width)]] = double;

/// Larger log likelihoods count as impossible. Then the sum of an element lies below
/// `smallest_sum`, and the element is computed from the sum of its log likelihoods instead.
constexpr float largest_logarithm = 300.0F;
constexpr double smallest_sum = 1e-200;

TOUCHDOWN_WIDE_VECTORS
void exponentials_of(const float* log, double* result, std::size_t levels) noexcept {
  for (std::size_t level = 0; level < levels; ++level) {
    const float* const row = log + level * phase_count;
    float largest = row[0];
    float magnitude = 0.0F;
    for (std::size_t k = 0; k < phase_count; ++k) {
      largest = std::max(largest, row[k]);
      magnitude = std::max(magnitude, std::abs(row[k]));
    }
    const bool is_usable = magnitude <= largest_logarithm;
    for (std::size_t k = 0; k < phase_count; ++k) {
      const double relative = static_cast<double>(row[k]) - static_cast<double>(largest);
      result[level * phase_count + k] = is_usable ? relative : -700.0;
    }
  }
  for (std::size_t i = 0; i < levels * phase_count; ++i) result[i] = exponential(result[i]);
}

/// The evidence of one element, by phase. The sum of two log likelihoods is rounded to a float, as
/// in `PhaseFilter`. The rounding error d enters as e^d.
[[gnu::always_inline]] inline void evidence_of(const float* first, const float* second,
                                               const double* e_first, const double* e_second,
                                               double* evidence) noexcept {
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#pragma GCC unroll 1
#endif
  for (std::size_t k = 0; k < phase_count; ++k) {
    const float rounded = first[k] + second[k];
    const double d = static_cast<double>(rounded) -
                     (static_cast<double>(first[k]) + static_cast<double>(second[k]));
    evidence[k] = e_first[k] * e_second[k] * (1.0 + d * (1.0 + d * (0.5 + d * (1.0 / 6))));
  }
}

/// The evidence of the elements of a block.
TOUCHDOWN_WIDE_VECTORS
void set_evidence(const PhaseLikelihoods& torque, const PhaseLikelihoods& acceleration,
                  const std::uint32_t* torque_level, const std::uint32_t* acceleration_level,
                  double* by_element, Block& by_phase) noexcept {
  for (std::size_t f = 0; f < batch_width; ++f) {
    evidence_of(torque.logarithms(torque_level[f]), acceleration.logarithms(acceleration_level[f]),
                torque.exponentials(torque_level[f]),
                acceleration.exponentials(acceleration_level[f]), by_element + f * phase_count);
  }
  for (std::size_t k = 0; k < phase_count; ++k) {
    for (std::size_t f = 0; f < batch_width; ++f) {
      by_phase.value[k][f] = by_element[f * phase_count + k];
    }
  }
}

/// One step of a block. Returns whether it succeeded; otherwise the block stays as it was.
TOUCHDOWN_WIDE_VECTORS
bool predict_and_correct(const BatchedPhaseRecursion::Transitions& transitions,
                         const Block& evidence, Block& alpha) noexcept {
  const auto load = [](const std::array<double, batch_width>& from, Values& to) {
    std::memcpy(&to, from.data(), sizeof to);
  };
  Values before;
  Values shared = {};
  for (std::size_t i = 0; i < phase_count; ++i) {
    load(alpha.value[i], before);
    shared += before * transitions.least[i];
  }
  std::array<Values, phase_count> corrected;
  Values sum = {};
  for (std::size_t k = 0; k < phase_count; ++k) {
    Values predicted = shared;
    for (std::size_t t = transitions.first[k]; t < transitions.first[k + 1]; ++t) {
      load(alpha.value[transitions.other[t].from], before);
      predicted += before * transitions.other[t].excess;
    }
    Values likelihood;
    load(evidence.value[k], likelihood);
    corrected[k] = predicted * likelihood;
    sum += corrected[k];
  }
  bool is_positive = true;
  for (std::size_t f = 0; f < batch_width; ++f) is_positive &= sum[f] >= smallest_sum;
  if (!is_positive) return false;
  const Values scale = 1.0 / sum;
  for (std::size_t k = 0; k < phase_count; ++k) {
    const Values normalised = corrected[k] * scale;
    std::memcpy(alpha.value[k].data(), &normalised, sizeof normalised);
  }
  return true;
}

std::vector<std::uint32_t> padded(std::span<const std::uint32_t> level) {
  std::vector<std::uint32_t> result(level.begin(), level.end());
  result.resize(padded_to_batch_width(level.size()), level.back());
  return result;
}

}  // namespace

void PhaseLikelihoods::set(std::size_t level, const PhaseRow& log_likelihood) noexcept {
  std::copy_n(log_likelihood.begin(), phase_count, log_.data() + level * phase_count);
}

void PhaseLikelihoods::update() noexcept {
  exponentials_of(log_.data(), exponential_.data(), log_.size() / phase_count);
}

BatchedPhaseRecursion::Transitions::Transitions(const PhaseRecursion& one) {
  for (std::size_t i = 0; i < phase_count; ++i) {
    least[i] = one.transition(i, 0);
    for (std::size_t j = 1; j < phase_count; ++j) {
      least[i] = std::min(least[i], one.transition(i, j));
    }
  }
  for (std::size_t j = 0; j < phase_count; ++j) {
    for (std::size_t i = 0; i < phase_count; ++i) {
      const double excess = one.transition(i, j) - least[i];
      if (excess > 0.0) other.push_back({static_cast<std::uint32_t>(i), excess});
    }
    first[j + 1] = other.size();
  }
}

BatchedPhaseRecursion::BatchedPhaseRecursion(const PhaseRecursion& one,
                                             std::span<const std::uint32_t> torque_level,
                                             std::span<const std::uint32_t> acceleration_level)
    : one_(one),
      transitions_(one),
      torque_level_(padded(torque_level)),
      acceleration_level_(padded(acceleration_level)) {
  Block prior{};
  for (std::size_t k = 0; k < phase_count; ++k) prior.value[k].fill(PhaseRecursion::prior[k]);
  alpha_.assign(torque_level_.size() / batch_width, prior);
}

void BatchedPhaseRecursion::update(const PhaseLikelihoods& torque,
                                   const PhaseLikelihoods& acceleration) noexcept {
  for (std::size_t block = 0; block < alpha_.size(); ++block) {
    const std::size_t element = block * batch_width;
    set_evidence(torque, acceleration, torque_level_.data() + element,
                 acceleration_level_.data() + element, by_element_.data(), evidence_);
    if (!predict_and_correct(transitions_, evidence_, alpha_[block])) {
      update_one_by_one(block, torque, acceleration);
    }
  }
}

/// For evidence with a product too small for a double.
void BatchedPhaseRecursion::update_one_by_one(std::size_t block, const PhaseLikelihoods& torque,
                                              const PhaseLikelihoods& acceleration) noexcept {
  for (std::size_t f = 0; f < batch_width; ++f) {
    const std::size_t element = block * batch_width + f;
    const float* const first = torque.logarithms(torque_level_[element]);
    const float* const second = acceleration.logarithms(acceleration_level_[element]);
    PhaseRecursion::Lanes log_likelihood{};
    PhaseRecursion::Lanes alpha{};
    for (std::size_t k = 0; k < phase_count; ++k) {
      log_likelihood[k] = static_cast<double>(first[k] + second[k]);
      alpha[k] = alpha_[block].value[k][f];
    }
    one_.predict_and_correct(alpha, log_likelihood);
    for (std::size_t k = 0; k < phase_count; ++k) alpha_[block].value[k][f] = alpha[k];
  }
}

}  // namespace touchdown::experiments
