#include "estimator/bayes/measurement_fit.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "estimator/numerics/kernel_density.hpp"

namespace touchdown {
namespace {

/// The torques of one class, joint by joint, and their bandwidth.
struct SamplesOfClass {
  std::vector<double> knee;
  std::vector<double> wheel;
  TorqueBandwidth bandwidth;
};

/// The bandwidth is by Scott's rule, unless the configuration gives it.
SamplesOfClass class_of(std::span<const TorqueSample> samples, const MeasurementFitConfig& config,
                        const char* name) {
  SamplesOfClass found;
  for (const TorqueSample& sample : samples) {
    found.knee.push_back(sample.knee);
    found.wheel.push_back(sample.wheel);
  }
  // Scott's rule also checks the samples, so it runs even if its result is not needed.
  constexpr double smallest = std::numeric_limits<double>::min();
  const TorqueBandwidth floor =
      config.bandwidth ? TorqueBandwidth{smallest, smallest} : config.bandwidth_floor;
  try {
    found.bandwidth = {scott_bandwidth(found.knee, 2, floor.knee),
                       scott_bandwidth(found.wheel, 2, floor.wheel)};
  } catch (const InputError& error) {
    throw InputError(std::string(name) + " torques: " + error.what());
  }
  if (config.bandwidth) found.bandwidth = *config.bandwidth;
  return found;
}

/// The configured range; otherwise all samples and four bandwidths more, but nothing below zero if
/// no sample is.
Axis axis_for(const SamplesOfClass& n, const SamplesOfClass& c,
              const std::optional<std::pair<double, double>>& range, int count,
              std::vector<double> SamplesOfClass::*torque, double TorqueBandwidth::*width) {
  if (range) return {range->first, range->second, count};
  const auto [n_lowest, n_highest] = std::ranges::minmax(n.*torque);
  const auto [c_lowest, c_highest] = std::ranges::minmax(c.*torque);
  const double lower =
      std::min(n_lowest - 4.0 * n.bandwidth.*width, c_lowest - 4.0 * c.bandwidth.*width);
  const double upper =
      std::max(n_highest + 4.0 * n.bandwidth.*width, c_highest + 4.0 * c.bandwidth.*width);
  return {std::min(n_lowest, c_lowest) >= 0.0 ? 0.0 : lower, upper, count};
}

std::vector<double> density_of(const SamplesOfClass& of_class, const Axis& knee,
                               const Axis& wheel) {
  return kernel_density(of_class.wheel, of_class.knee, of_class.bandwidth.wheel,
                        of_class.bandwidth.knee, wheel, knee);
}

}  // namespace

MeasurementFit fit_measurement(std::span<const TorqueSample> contact,
                               std::span<const TorqueSample> no_contact,
                               const MeasurementFitConfig& config) {
  const SamplesOfClass c = class_of(contact, config, "contact");
  const SamplesOfClass n = class_of(no_contact, config, "no-contact");
  const Axis knee = axis_for(n, c, config.knee_range, config.knee_count, &SamplesOfClass::knee,
                             &TorqueBandwidth::knee);
  const Axis wheel = axis_for(n, c, config.wheel_range, config.wheel_count, &SamplesOfClass::wheel,
                              &TorqueBandwidth::wheel);
  return {MeasurementModel(
              LikelihoodGrids{knee, wheel, density_of(c, knee, wheel), density_of(n, knee, wheel)}),
          {n.bandwidth, c.bandwidth}};
}

MeasurementModel fit_measurement_model(std::span<const TorqueSample> contact,
                                       std::span<const TorqueSample> no_contact,
                                       const MeasurementFitConfig& config) {
  return fit_measurement(contact, no_contact, config).model;
}

}  // namespace touchdown
