#include "experiments/results/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "estimator/evidence/channels.hpp"
#include "experiments/estimators/decision.hpp"
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

void add_curve(Table& table, const std::vector<std::string>& first_cells,
               const EvidenceModel& model, std::size_t input) {
  const bool is_noise = input >= decision_channels * decision_scales;
  const std::size_t channel = input / decision_scales;
  const auto scale = std::to_string(1U << (input % decision_scales));
  for (const float x : knots_of(model.seen[input])) {
    std::vector<std::string> row = first_cells;
    const double input_value = static_cast<double>(x);
    if (is_noise) {
      const std::size_t which = input - decision_channels * decision_scales;
      row.insert(row.end(), {evidence_noise_names[which], "", which == 0 ? "N·m" : "m/s²",
                             metric(std::exp(input_value))});
    } else {
      const EvidenceChannel& shown = evidence_channels[channel];
      row.insert(row.end(),
                 {shown.name, scale, shown.unit,
                  metric(uncompressed(input_value, static_cast<double>(shown.softsign_scale)))});
    }
    row.push_back(metric(static_cast<double>(evidence_at(model.curve[input], x))));
    table.rows.push_back(std::move(row));
  }
}

}  // namespace

Table evidence_table(const FittedModels& models) {
  Table table{{"simulator", "estimator", "channel", "scale_ms", "unit", "value", "evidence_nats"},
              {}};
  for (const auto& [simulator, by_estimator] : models) {
    if (is_of_refit(simulator)) continue;
    for (const auto& [estimator, fitted] : by_estimator) {
      const std::optional<EvidenceModel> model = evidence_in(fitted);
      if (!model) continue;
      for (std::size_t input = 0; input < decision_inputs; ++input) {
        add_curve(table, {simulator, estimator}, *model, input);
      }
    }
  }
  return table;
}

}  // namespace touchdown::experiments
