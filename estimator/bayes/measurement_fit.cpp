#include "estimator/bayes/measurement_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "estimator/numerics/kernel_density.hpp"

namespace touchdown {
namespace {

/// Welford's update: one pass, no cancellation.
void add(double value, double count, double& mean, double& squares) noexcept {
  const double before = value - mean;
  mean += before / count;
  squares += before * (value - mean);
}

double deviation(double squares, std::size_t count) noexcept {
  return std::sqrt(squares / (static_cast<double>(count) - 1.0));
}

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

}  // namespace

MeasurementModel fit_measurement_model(std::span<const TorqueSample> contact,
                                       std::span<const TorqueSample> no_contact,
                                       const MeasurementFitConfig& config) {
  MeasurementFit fit(config);
  fit.of(true).bandwidth = bandwidth_for(contact, config, "contact");
  fit.of(false).bandwidth = bandwidth_for(no_contact, config, "no-contact");
  for (const TorqueSample& sample : contact) fit.survey(true, sample);
  for (const TorqueSample& sample : no_contact) fit.survey(false, sample);
  fit.make_grids();
  for (const TorqueSample& sample : contact) fit.add(true, sample);
  for (const TorqueSample& sample : no_contact) fit.add(false, sample);
  return fit.model();
}

MeasurementFit::MeasurementFit(const MeasurementFitConfig& config) : config_(config) {}
MeasurementFit::~MeasurementFit() = default;

void TorqueSurvey::add(const TorqueSample& sample) noexcept {
  ++count;
  const auto n = static_cast<double>(count);
  touchdown::add(sample.knee, n, mean.knee, squares.knee);
  touchdown::add(sample.wheel, n, mean.wheel, squares.wheel);
  if (count == 1) lowest = highest = sample;
  lowest = {std::min(lowest.knee, sample.knee), std::min(lowest.wheel, sample.wheel)};
  highest = {std::max(highest.knee, sample.knee), std::max(highest.wheel, sample.wheel)};
}

void MeasurementFit::survey(bool contact, const TorqueSample& sample) {
  if (!std::isfinite(sample.knee) || !std::isfinite(sample.wheel)) {
    throw InputError("torques that are fitted must be finite");
  }
  of(contact).survey.add(sample);
}

void MeasurementFit::choose_bandwidth(Class& of_class, const char* name) const {
  const TorqueSurvey& survey = of_class.survey;
  if (survey.count < 2) {
    throw InputError(std::string(name) + " torques: at least 2 samples are needed, got " +
                     std::to_string(survey.count));
  }
  if (config_.bandwidth) {
    of_class.bandwidth = *config_.bandwidth;
    return;
  }
  const auto n = static_cast<double>(survey.count);
  const TorqueBandwidth floor = config_.bandwidth_floor;
  try {
    of_class.bandwidth = {
        scott_bandwidth(n, deviation(survey.squares.knee, survey.count), 2, floor.knee),
        scott_bandwidth(n, deviation(survey.squares.wheel, survey.count), 2, floor.wheel)};
  } catch (const InputError& error) {
    throw InputError(std::string(name) + " torques: " + error.what());
  }
}

void MeasurementFit::prepare() {
  choose_bandwidth(of(true), "contact");
  choose_bandwidth(of(false), "no-contact");
  make_grids();
}

/// The configured range; otherwise all samples and four bandwidths more, but nothing below zero if
/// no sample is.
Axis MeasurementFit::axis_for(const std::optional<std::pair<double, double>>& range, int count,
                              double TorqueSample::*torque, double TorqueBandwidth::*width) const {
  if (range) return {range->first, range->second, count};
  const auto& [n, c] = class_;
  const double lowest = std::min(n.survey.lowest.*torque, c.survey.lowest.*torque);
  const double lower = std::min(n.survey.lowest.*torque - 4.0 * n.bandwidth.*width,
                                c.survey.lowest.*torque - 4.0 * c.bandwidth.*width);
  const double upper = std::max(n.survey.highest.*torque + 4.0 * n.bandwidth.*width,
                                c.survey.highest.*torque + 4.0 * c.bandwidth.*width);
  return {lowest >= 0.0 ? 0.0 : lower, upper, count};
}

void MeasurementFit::make_grids() {
  knee_ =
      axis_for(config_.knee_range, config_.knee_count, &TorqueSample::knee, &TorqueBandwidth::knee);
  wheel_ = axis_for(config_.wheel_range, config_.wheel_count, &TorqueSample::wheel,
                    &TorqueBandwidth::wheel);
  for (Class& one : class_) {
    one.density =
        std::make_unique<KernelDensityGrid>(one.bandwidth.wheel, one.bandwidth.knee, wheel_, knee_);
  }
}

void MeasurementFit::add(bool contact, const TorqueSample& sample) {
  of(contact).density->add(sample.wheel, sample.knee);
}

MeasurementModel MeasurementFit::model() {
  return MeasurementModel(
      LikelihoodGrids{knee_, wheel_, of(true).density->density(), of(false).density->density()});
}

}  // namespace touchdown
