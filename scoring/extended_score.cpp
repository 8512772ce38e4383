#include "scoring/extended_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace touchdown::scoring {

void LoadScore::add(double normal_force, const WheelLoad& load) {
  ++steps;
  const double error = std::abs(load.force - normal_force);
  if (std::isnan(error)) return;
  const double bin = error < largest_fine
                         ? error / bin_width
                         : static_cast<double>(fine) + std::log(error / largest_fine) / growth;
  ++errors[static_cast<std::size_t>(std::min(bin, static_cast<double>(count - 1)))];
  covered += error <= 2.0 * load.deviation ? 1 : 0;
}

LoadScore& LoadScore::operator+=(const LoadScore& other) {
  for (std::size_t i = 0; i < count; ++i) errors[i] += other.errors[i];
  covered += other.covered;
  steps += other.steps;
  return *this;
}

double LoadScore::median_error() const {
  const std::int64_t all = known();
  std::int64_t passed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    passed += errors[i];
    if (all == 0 || 2 * passed < all) continue;
    const double middle = static_cast<double>(i) + 0.5;
    return i < fine ? bin_width * middle
                    : largest_fine * std::exp(growth * (middle - static_cast<double>(fine)));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

ExtendedScore& ExtendedScore::operator+=(const ExtendedScore& other) {
  loaded += other.loaded;
  load += other.load;
  log_loss += other.log_loss;
  steps += other.steps;
  return *this;
}

ExtendedScore extended_score(
    const std::array<ContactSequence, models::wheel_count>& truth,
    const std::array<std::vector<double>, models::wheel_count>& normal_force,
    const Prediction& prediction, std::int64_t period_us, const ScoringConfig& config) {
  constexpr double loaded_force = 10.0;  // N
  constexpr double least_probability = 1e-6;
  ExtendedScore result;
  const std::size_t first = first_scored_step(period_us, config);
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    const ContactSequence& predicted = prediction[w].contact;
    for (std::size_t k = first; k < truth[w].size(); ++k) {
      const bool in_contact = truth[w][k] != 0;
      if (!in_contact || normal_force[w][k] >= loaded_force)
        result.loaded.add(in_contact, predicted[k] != 0);
      const double p_contact = prediction[w].p_contact[k];
      result.log_loss -=
          std::log(std::clamp(in_contact ? p_contact : 1.0 - p_contact, least_probability, 1.0));
      result.steps += 1;
      if (!prediction[w].load.empty()) {
        result.load.add(normal_force[w][k], prediction[w].load[k]);
      }
    }
  }
  return result;
}

}  // namespace touchdown::scoring
