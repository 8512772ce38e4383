#include "experiments/studies/operating_points/config.hpp"

#include <algorithm>
#include <functional>

#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

static void describe(Fields& fields, OperatingPointsConfig& config,
                     const Experiment& /*experiment*/) {
  const auto describe_thresholds = [&](const char* key, std::vector<double>& thresholds) {
    const KeyNotes notes = fields.in_line(key, thresholds);
    fields.check(!thresholds.empty(), key, "expected at least one probability");
    fields.check(thresholds.empty() ||
                     (thresholds.front() > 0.0 && thresholds.back() < 1.0 &&
                      std::is_sorted(thresholds.begin(), thresholds.end(), std::less_equal<>())),
                 key, "expected increasing probabilities, none of them 0 or 1");
    return notes.range("between 0 and 1, increasing");
  };
  describe_thresholds("leave_below", config.leave_below)
      .doc("Thresholds of P(contact) below which contact ends.");
  describe_thresholds("return_above", config.return_above)
      .doc("Thresholds of P(contact) above which contact begins.");
  fields.check(config.leave_below.front() <= config.return_above.back(), "return_above",
               "expected a threshold of at least the lowest leave_below");
}

std::vector<scoring::Hysteresis> points_of(const OperatingPointsConfig& config) {
  std::vector<scoring::Hysteresis> points;
  for (const double leave_below : config.leave_below) {
    for (const double return_above : config.return_above) {
      if (leave_below <= return_above) points.push_back({leave_below, return_above});
    }
  }
  return points;
}

StudySection operating_points_section() {
  return optional_section<OperatingPointsConfig>(
      "operating_points", "Scores of every estimator with other thresholds.");
}

}  // namespace touchdown::experiments
