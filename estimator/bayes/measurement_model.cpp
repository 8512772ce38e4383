#include "estimator/bayes/measurement_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"

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

}  // namespace

std::vector<double> contact_probability(const LikelihoodGrids& grids) {
  std::vector<double> probability(grids.contact.size());
  for (std::size_t i = 0; i < probability.size(); ++i) {
    probability[i] = measurement_probability({grids.contact[i], grids.no_contact[i]});
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
  for (std::size_t i = 0; i < count; ++i) (*cells)[i] = {grids.contact[i], grids.no_contact[i]};
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

}  // namespace touchdown
