#include "experiments/results/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "estimator/evidence/channels.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/plan/condition.hpp"

namespace touchdown::experiments {

namespace {

/// The ends of the range of fitted rows, and the knots inside it.
std::set<float> knots_of(const std::array<float, 2>& seen) {
  std::set<float> knots = {seen[0], seen[1]};
  for (std::size_t k = 0; k < evidence_knots; ++k) {
    const float x = evidence_reach * (2.0F * static_cast<float>(k) / (evidence_knots - 1) - 1.0F);
    if (x > seen[0] && x < seen[1]) knots.insert(x);
  }
  return knots;
}

constexpr std::size_t first_noise = decision_channels * decision_scales;

/// The channel of an input that is no noise level; inputs as `curve_of` numbers curves.
const EvidenceChannel& channel_of(std::size_t input) {
  return input < decision_inputs ? evidence_channels[input / decision_scales]
                                 : servo_load_channels[(input - decision_inputs) / decision_scales];
}

bool is_noise_level(std::size_t input) { return input >= first_noise && input < decision_inputs; }

/// An input of the network: its channel's name, time scale and unit.
EvidencePoint input_of(std::size_t input) {
  if (is_noise_level(input)) {
    const std::size_t noise = input - first_noise;
    return {.channel = evidence_noise_names[noise], .unit = noise == 0 ? "N·m" : "m/s²"};
  }
  const EvidenceChannel& channel = channel_of(input);
  const std::size_t scale = input < decision_inputs ? input : input - decision_inputs;
  return {.channel = channel.name,
          .scale = std::to_string(1U << (scale % decision_scales)),
          .unit = channel.unit};
}

/// An input in the unit of its channel.
double in_unit(std::size_t input, double x) {
  if (is_noise_level(input)) return std::exp(x);
  return uncompressed(x, static_cast<double>(channel_of(input).softsign_scale));
}

/// Adds the points of one set of curves.
void add_points(const EvidenceModel& model, const EvidencePoint& of_fit,
                std::vector<EvidencePoint>& points) {
  for (std::size_t input = 0; input < curve_count(model); ++input) {
    for (const float x : knots_of(seen_by(model, input))) {
      EvidencePoint& point = points.emplace_back(input_of(input));
      point.simulator = of_fit.simulator;
      point.estimator = of_fit.estimator;
      point.targets = targets_of(model);
      point.value = in_unit(input, static_cast<double>(x));
      point.evidence = static_cast<double>(evidence_at(curve_of(model, input), x));
    }
  }
}

}  // namespace

std::vector<EvidencePoint> evidence_points(const FittedModels& models) {
  std::vector<EvidencePoint> points;
  for (const auto& [simulator, by_estimator] : models) {
    if (is_of_refit(simulator)) continue;
    for (const auto& [estimator, fitted] : by_estimator) {
      const std::optional<EvidenceCurveSets> sets = evidence_in(fitted);
      if (!sets) continue;
      const EvidencePoint of_fit = {.simulator = simulator, .estimator = estimator};
      add_points(sets->usual, of_fit, points);
      if (sets->without_targets) add_points(*sets->without_targets, of_fit, points);
    }
  }
  return points;
}

Columns<EvidencePoint> evidence_columns() {
  using Point = EvidencePoint;
  return Columns<Point>()
      .text("simulator", &Point::simulator)
      .text("estimator", &Point::estimator)
      .text("targets", &Point::targets)
      .text("channel", &Point::channel)
      .text("scale_ms", &Point::scale)
      .text("unit", &Point::unit)
      .metric("value", &Point::value)
      .metric("evidence_nats", &Point::evidence);
}

}  // namespace touchdown::experiments
