#include "estimator/measurement_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "estimator/kernel_density.hpp"

namespace touchdown {
namespace {

std::size_t cell_count(const Axis& knee, const Axis& wheel) {
  return static_cast<std::size_t>(knee.count) * static_cast<std::size_t>(wheel.count);
}

void check_grid(std::span<const double> grid, std::size_t expected, const char* name) {
  if (grid.size() != expected) {
    throw InputError(std::string(name) + " likelihood: expected " + std::to_string(expected) +
                     " values (wheel points × knee points), got " + std::to_string(grid.size()));
  }
  const bool good = std::all_of(grid.begin(), grid.end(),
                                [](double value) { return std::isfinite(value) && value >= 0.0; });
  if (!good) {
    throw InputError(std::string(name) + " likelihood: expected finite values, zero or more");
  }
}

std::vector<double> in_wheel_rows(std::span<const double> values, const Axis& knee,
                                  const Axis& wheel, GridRows rows) {
  if (rows == GridRows::wheel || values.size() != cell_count(knee, wheel)) {
    return {values.begin(), values.end()};
  }
  const auto knees = static_cast<std::size_t>(knee.count);
  const auto wheels = static_cast<std::size_t>(wheel.count);
  std::vector<double> turned(values.size());
  for (std::size_t i = 0; i < wheels; ++i) {
    for (std::size_t j = 0; j < knees; ++j) {
      turned[i * knees + j] = values[j * wheels + i];
    }
  }
  return turned;
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
  fitted.knee.reserve(samples.size());
  fitted.wheel.reserve(samples.size());
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

Axis covering_axis(const std::vector<double>& a, double a_bandwidth, const std::vector<double>& b,
                   double b_bandwidth, int count) {
  const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end());
  const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end());
  const double lowest = std::min(*a_low, *b_low);
  const double lower = std::min(*a_low - 4.0 * a_bandwidth, *b_low - 4.0 * b_bandwidth);
  const double upper = std::max(*a_high + 4.0 * a_bandwidth, *b_high + 4.0 * b_bandwidth);
  return {lowest >= 0.0 ? 0.0 : lower, upper, count};
}

}  // namespace

LikelihoodGrids likelihood_grids(std::span<const double> knee_points,
                                 std::span<const double> wheel_points,
                                 std::span<const double> contact,
                                 std::span<const double> no_contact, GridRows rows) {
  const Axis knee = axis_from_points(knee_points);
  const Axis wheel = axis_from_points(wheel_points);
  LikelihoodGrids grids{knee, wheel, in_wheel_rows(contact, knee, wheel, rows),
                        in_wheel_rows(no_contact, knee, wheel, rows)};
  check_grid(grids.contact, cell_count(knee, wheel), "contact");
  check_grid(grids.no_contact, cell_count(knee, wheel), "no-contact");
  return grids;
}

std::vector<double> contact_probability(const LikelihoodGrids& grids) {
  std::vector<double> probability(grids.contact.size());
  for (std::size_t i = 0; i < probability.size(); ++i) {
    const double sum = grids.contact[i] + grids.no_contact[i];
    probability[i] = sum > 0.0 ? grids.contact[i] / sum : 0.5;
  }
  return probability;
}

MeasurementModel::MeasurementModel(const LikelihoodGrids& grids)
    : knee_axis_(grids.knee), wheel_axis_(grids.wheel), row_(grids.knee.count) {
  check_axis(grids.knee, "knee torque");
  check_axis(grids.wheel, "wheel torque");
  const std::size_t count = cell_count(grids.knee, grids.wheel);
  check_grid(grids.contact, count, "contact");
  check_grid(grids.no_contact, count, "no-contact");
  auto cells = std::make_shared<std::vector<Likelihoods>>(count);
  for (std::size_t i = 0; i < count; ++i) {
    (*cells)[i] = {grids.contact[i], grids.no_contact[i]};
  }
  knee_ = AxisLookup(grids.knee);
  wheel_ = AxisLookup(grids.wheel);
  cells_ = cells->data();
  storage_ = std::move(cells);
}

LikelihoodGrids MeasurementModel::grids() const {
  LikelihoodGrids grids{knee_axis_, wheel_axis_, {}, {}};
  grids.contact.reserve(storage_->size());
  grids.no_contact.reserve(storage_->size());
  for (const Likelihoods& cell : *storage_) {
    grids.contact.push_back(cell.contact);
    grids.no_contact.push_back(cell.no_contact);
  }
  return grids;
}

MeasurementModel fit_measurement_model(std::span<const TorqueSample> contact,
                                       std::span<const TorqueSample> no_contact,
                                       const MeasurementFitConfig& config) {
  const FittedClass c = fit_class(contact, config, "contact");
  const FittedClass n = fit_class(no_contact, config, "no-contact");
  Axis knee = covering_axis(c.knee, c.bandwidth.knee, n.knee, n.bandwidth.knee, config.knee_count);
  Axis wheel =
      covering_axis(c.wheel, c.bandwidth.wheel, n.wheel, n.bandwidth.wheel, config.wheel_count);
  if (config.knee_range) {
    knee = {config.knee_range->first, config.knee_range->second, config.knee_count};
  }
  if (config.wheel_range) {
    wheel = {config.wheel_range->first, config.wheel_range->second, config.wheel_count};
  }
  return MeasurementModel(LikelihoodGrids{
      knee, wheel,
      kernel_density(c.wheel, c.knee, c.bandwidth.wheel, c.bandwidth.knee, wheel, knee),
      kernel_density(n.wheel, n.knee, n.bandwidth.wheel, n.bandwidth.knee, wheel, knee)});
}

}  // namespace touchdown
