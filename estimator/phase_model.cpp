#include "estimator/phase_model.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"

namespace touchdown {
namespace {

void check_transition(const PhaseTransition& transition) {
  for (std::size_t i = 0; i < phase_count; ++i) {
    double sum = 0.0;
    for (const double p : transition[i]) {
      if (!(p >= 0.0 && p <= 1.0)) {
        throw InputError("phase model: transitions must be probabilities");
      }
      sum += p;
    }
    if (!(std::abs(sum - 1.0) < 1e-6)) {
      throw InputError("phase model: transitions from " + std::string(phase_names[i]) + " sum to " +
                       std::to_string(sum) + " instead of 1");
    }
  }
}

void check_grid(const std::vector<float>& values, std::size_t expected, const char* name) {
  if (values.size() != expected) {
    throw InputError(std::string("phase model: the ") + name + " density has " +
                     std::to_string(values.size()) + " values, its axes ask for " +
                     std::to_string(expected));
  }
  for (const float value : values) {
    if (!std::isfinite(value)) {
      throw InputError(std::string("phase model: the ") + name + " density is not finite");
    }
  }
}

template <typename Density>
void check_levels(const std::vector<Density>& densities, const char* name) {
  if (densities.empty()) {
    throw InputError(std::string("phase model: there is no ") + name + " density");
  }
  for (std::size_t i = 0; i < densities.size(); ++i) {
    if (!(densities[i].bandwidth > 0.0) || !std::isfinite(densities[i].bandwidth) ||
        (i > 0 && !(densities[i].bandwidth > densities[i - 1].bandwidth))) {
      throw InputError(std::string("phase model: the ") + name +
                       " densities must come with increasing bandwidths");
    }
  }
}

}  // namespace

void check_phase_model(const PhaseModel& model) {
  if (!(std::isfinite(model.sample_rate) && model.sample_rate > 0.0)) {
    throw InputError("phase model: the sample rate must be positive (Hz)");
  }
  check_transition(model.transition);
  check_levels(model.torque, "torque");
  check_levels(model.acceleration, "acceleration");
  for (const PhaseTorqueDensity& density : model.torque) {
    check_axis(density.knee, "knee torque");
    check_axis(density.wheel, "wheel torque");
    check_grid(density.log_density,
               static_cast<std::size_t>(density.knee.count) *
                   static_cast<std::size_t>(density.wheel.count) * torque_density_count,
               "torque");
  }
  for (const PhaseAccelerationDensity& density : model.acceleration) {
    check_axis(density.axis, "acceleration");
    check_grid(density.log_density,
               static_cast<std::size_t>(density.axis.count) * acceleration_density_count,
               "acceleration");
  }
}

PhaseTransition count_transitions(std::span<const Phase> phases) {
  PhaseTransition counts{};
  for (std::size_t k = 1; k < phases.size(); ++k) {
    counts[index(phases[k - 1])][index(phases[k])] += 0.5;
    counts[index(mirrored(phases[k - 1]))][index(mirrored(phases[k]))] += 0.5;
  }
  return counts;
}

PhaseTransition transition_probabilities(const PhaseTransition& counts, double pseudo_count) {
  PhaseTransition transition{};
  for (std::size_t i = 0; i < phase_count; ++i) {
    double sum = 0.0;
    for (const double count : counts[i]) sum += count + pseudo_count;
    for (std::size_t j = 0; j < phase_count; ++j) {
      transition[i][j] = (counts[i][j] + pseudo_count) / sum;
    }
  }
  return transition;
}

}  // namespace touchdown
