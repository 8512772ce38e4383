#include "estimator/phase/model.hpp"

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

void check_increasing(const std::vector<double>& bandwidths, const char* name) {
  if (bandwidths.empty()) {
    throw InputError(std::string("phase model: there is no ") + name + " density");
  }
  for (std::size_t i = 0; i < bandwidths.size(); ++i) {
    if (!(bandwidths[i] > 0.0) || !std::isfinite(bandwidths[i]) ||
        (i > 0 && !(bandwidths[i] > bandwidths[i - 1]))) {
      throw InputError(std::string("phase model: the ") + name +
                       " densities must come with increasing bandwidths");
    }
  }
}

void check_levels(const std::vector<PhaseTorqueDensity>& densities) {
  const std::size_t n = torque_level_count(densities);
  std::vector<double> bandwidths;
  for (std::size_t i = 0; i < n; ++i) bandwidths.push_back(densities[i].bandwidth.wheel);
  check_increasing(bandwidths, "torque");
  for (std::size_t i = 0; i < n * n; ++i) {
    if (densities[i].bandwidth.knee != bandwidths[i / n] ||
        densities[i].bandwidth.wheel != bandwidths[i % n]) {
      throw InputError(
          "phase model: the torque densities must come knee by knee, wheel by wheel, "
          "with the same bandwidths at both");
    }
  }
}

void check_levels(const std::vector<PhaseAccelerationDensity>& densities) {
  std::vector<double> bandwidths;
  for (const PhaseAccelerationDensity& density : densities) bandwidths.push_back(density.bandwidth);
  check_increasing(bandwidths, "acceleration");
}

}  // namespace

std::size_t torque_level_count(std::span<const PhaseTorqueDensity> densities) {
  const auto n =
      static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(densities.size()))));
  if (densities.empty()) throw InputError("phase model: there is no torque density");
  if (n * n != densities.size()) {
    throw InputError("phase model: " + std::to_string(densities.size()) +
                     " torque densities are not one for each noise level at the knee and at the "
                     "wheel");
  }
  return n;
}

void check_phase_model(const PhaseModel& model) {
  if (!(std::isfinite(model.sample_rate) && model.sample_rate > 0.0)) {
    throw InputError("phase model: the sample rate must be positive (Hz)");
  }
  check_transition(model.transition);
  check_levels(model.torque);
  check_levels(model.acceleration);
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

}  // namespace touchdown
