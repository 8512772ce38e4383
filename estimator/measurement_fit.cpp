#include "estimator/measurement_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"

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

/// All samples and four bandwidths more, but nothing below zero if no sample is.
Axis covering_axis(double lowest_a, double highest_a, double bandwidth_a, double lowest_b,
                   double highest_b, double bandwidth_b, int count) {
  const double lower = std::min(lowest_a - 4.0 * bandwidth_a, lowest_b - 4.0 * bandwidth_b);
  const double upper = std::max(highest_a + 4.0 * bandwidth_a, highest_b + 4.0 * bandwidth_b);
  return {std::min(lowest_a, lowest_b) >= 0.0 ? 0.0 : lower, upper, count};
}

}  // namespace

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
  const auto axis = [&](double TorqueSample::*torque, double TorqueBandwidth::*width, int count,
                        const std::optional<std::pair<double, double>>& range) {
    if (range) return Axis{range->first, range->second, count};
    return covering_axis(c.survey.lowest.*torque, c.survey.highest.*torque, c.bandwidth.*width,
                         n.survey.lowest.*torque, n.survey.highest.*torque, n.bandwidth.*width,
                         count);
  };
  knee_ = axis(&TorqueSample::knee, &TorqueBandwidth::knee, config_.knee_count, config_.knee_range);
  wheel_ =
      axis(&TorqueSample::wheel, &TorqueBandwidth::wheel, config_.wheel_count, config_.wheel_range);
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
