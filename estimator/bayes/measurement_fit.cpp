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

/// What an axis has to cover: one class's samples, by their ends, and its bandwidth.
struct Extent {
  double lowest;
  double highest;
  double bandwidth;
};

/// The range that was asked for, or all samples and four bandwidths more, but nothing below zero if
/// no sample is.
Axis axis_for(const std::optional<std::pair<double, double>>& range, int count, const Extent& a,
              const Extent& b) {
  if (range) return {range->first, range->second, count};
  const double lower = std::min(a.lowest - 4.0 * a.bandwidth, b.lowest - 4.0 * b.bandwidth);
  const double upper = std::max(a.highest + 4.0 * a.bandwidth, b.highest + 4.0 * b.bandwidth);
  return {std::min(a.lowest, b.lowest) >= 0.0 ? 0.0 : lower, upper, count};
}

/// Samples of one class along each axis, and their bandwidths.
struct FittedClass {
  std::vector<double> knee;
  std::vector<double> wheel;
  TorqueBandwidth bandwidth;
};

FittedClass fit_class(std::span<const TorqueSample> samples, const MeasurementFitConfig& config,
                      const char* name) {
  FittedClass fitted;
  for (const TorqueSample& sample : samples) {
    fitted.knee.push_back(sample.knee);
    fitted.wheel.push_back(sample.wheel);
  }
  try {
    // Scott's rule also checks the samples, so it runs even if its result is not needed.
    const double smallest = std::numeric_limits<double>::min();
    const bool given = config.bandwidth.has_value();
    const double knee =
        scott_bandwidth(fitted.knee, 2, given ? smallest : config.bandwidth_floor.knee);
    const double wheel =
        scott_bandwidth(fitted.wheel, 2, given ? smallest : config.bandwidth_floor.wheel);
    fitted.bandwidth = config.bandwidth.value_or(TorqueBandwidth{knee, wheel});
  } catch (const InputError& error) {
    throw InputError(std::string(name) + " torques: " + error.what());
  }
  return fitted;
}

Extent extent(const std::vector<double>& samples, double bandwidth) {
  const auto [lowest, highest] = std::minmax_element(samples.begin(), samples.end());
  return {*lowest, *highest, bandwidth};
}

}  // namespace

MeasurementModel fit_measurement_model(std::span<const TorqueSample> contact,
                                       std::span<const TorqueSample> no_contact,
                                       const MeasurementFitConfig& config) {
  const FittedClass c = fit_class(contact, config, "contact");
  const FittedClass n = fit_class(no_contact, config, "no-contact");
  const Axis knee = axis_for(config.knee_range, config.knee_count, extent(c.knee, c.bandwidth.knee),
                             extent(n.knee, n.bandwidth.knee));
  const Axis wheel =
      axis_for(config.wheel_range, config.wheel_count, extent(c.wheel, c.bandwidth.wheel),
               extent(n.wheel, n.bandwidth.wheel));
  return MeasurementModel(LikelihoodGrids{
      knee, wheel,
      kernel_density(c.wheel, c.knee, c.bandwidth.wheel, c.bandwidth.knee, wheel, knee),
      kernel_density(n.wheel, n.knee, n.bandwidth.wheel, n.bandwidth.knee, wheel, knee)});
}

MeasurementFit::MeasurementFit(const MeasurementFitConfig& config) : config_(config) {}
MeasurementFit::~MeasurementFit() = default;

void TorqueSurvey::add(const TorqueSample& sample) noexcept {
  ++count;
  const auto n = static_cast<double>(count);
  touchdown::add(sample.knee, n, mean.knee, squares.knee);
  touchdown::add(sample.wheel, n, mean.wheel, squares.wheel);
  if (count == 1) {
    lowest = highest = sample;
  }
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
  Class& c = of(true);
  Class& n = of(false);
  choose_bandwidth(c, "contact");
  choose_bandwidth(n, "no-contact");
  const auto extent_of = [](const Class& one, auto torque, auto width) {
    return Extent{one.survey.lowest.*torque, one.survey.highest.*torque, one.bandwidth.*width};
  };
  knee_ = axis_for(config_.knee_range, config_.knee_count,
                   extent_of(c, &TorqueSample::knee, &TorqueBandwidth::knee),
                   extent_of(n, &TorqueSample::knee, &TorqueBandwidth::knee));
  wheel_ = axis_for(config_.wheel_range, config_.wheel_count,
                    extent_of(c, &TorqueSample::wheel, &TorqueBandwidth::wheel),
                    extent_of(n, &TorqueSample::wheel, &TorqueBandwidth::wheel));
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
