#include "estimator/bayes/measurement_fit.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "estimator/numerics/kernel_density.hpp"

namespace touchdown {
namespace {

/// Scott's rule over the samples, unless the configuration gives the bandwidth.
TorqueBandwidth bandwidth_for(std::span<const TorqueSample> samples,
                              const MeasurementFitConfig& config, const char* name) {
  std::vector<double> knee;
  std::vector<double> wheel;
  for (const TorqueSample& sample : samples) {
    knee.push_back(sample.knee);
    wheel.push_back(sample.wheel);
  }
  // Scott's rule also checks the samples, so it runs even if its result is not needed.
  constexpr double smallest = std::numeric_limits<double>::min();
  const TorqueBandwidth floor =
      config.bandwidth ? TorqueBandwidth{smallest, smallest} : config.bandwidth_floor;
  try {
    const TorqueBandwidth scott = {scott_bandwidth(knee, 2, floor.knee),
                                   scott_bandwidth(wheel, 2, floor.wheel)};
    return config.bandwidth.value_or(scott);
  } catch (const InputError& error) {
    throw InputError(std::string(name) + " torques: " + error.what());
  }
}

/// The samples of one class, their bandwidth and their range.
struct SamplesOfClass {
  std::span<const TorqueSample> samples;
  TorqueBandwidth bandwidth;
  TorqueSample lowest;
  TorqueSample highest;
};

SamplesOfClass class_of(std::span<const TorqueSample> samples, const MeasurementFitConfig& config,
                        const char* name) {
  SamplesOfClass found{samples, bandwidth_for(samples, config, name), {}, {}};
  found.lowest = found.highest = samples.front();
  for (const TorqueSample& sample : samples) {
    found.lowest = {std::min(found.lowest.knee, sample.knee),
                    std::min(found.lowest.wheel, sample.wheel)};
    found.highest = {std::max(found.highest.knee, sample.knee),
                     std::max(found.highest.wheel, sample.wheel)};
  }
  return found;
}

/// The configured range; otherwise all samples and four bandwidths more, but nothing below zero if
/// no sample is.
Axis axis_for(const SamplesOfClass& n, const SamplesOfClass& c,
              const std::optional<std::pair<double, double>>& range, int count,
              double TorqueSample::*torque, double TorqueBandwidth::*width) {
  if (range) return {range->first, range->second, count};
  const double lowest = std::min(n.lowest.*torque, c.lowest.*torque);
  const double lower = std::min(n.lowest.*torque - 4.0 * n.bandwidth.*width,
                                c.lowest.*torque - 4.0 * c.bandwidth.*width);
  const double upper = std::max(n.highest.*torque + 4.0 * n.bandwidth.*width,
                                c.highest.*torque + 4.0 * c.bandwidth.*width);
  return {lowest >= 0.0 ? 0.0 : lower, upper, count};
}

std::vector<double> density_of(const SamplesOfClass& of_class, const Axis& knee,
                               const Axis& wheel) {
  KernelDensityGrid density(of_class.bandwidth.wheel, of_class.bandwidth.knee, wheel, knee);
  for (const TorqueSample& sample : of_class.samples) density.add(sample.wheel, sample.knee);
  return density.density();
}

}  // namespace

MeasurementFit fit_measurement(std::span<const TorqueSample> contact,
                               std::span<const TorqueSample> no_contact,
                               const MeasurementFitConfig& config) {
  const SamplesOfClass c = class_of(contact, config, "contact");
  const SamplesOfClass n = class_of(no_contact, config, "no-contact");
  const Axis knee = axis_for(n, c, config.knee_range, config.knee_count, &TorqueSample::knee,
                             &TorqueBandwidth::knee);
  const Axis wheel = axis_for(n, c, config.wheel_range, config.wheel_count, &TorqueSample::wheel,
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
