#include "experiments/studies/operating_points/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

namespace {

/// A threshold as a cell; empty for an estimator's own decision.
template <typename Row>
auto threshold(double scoring::Hysteresis::*one) {
  return [one](const Row& row) {
    return row.thresholds ? exact((*row.thresholds).*one) : std::string();
  };
}

/// The columns that both tables have: estimator, noise and thresholds.
template <typename Row>
Columns<Row> point_columns() {
  return Columns<Row>()
      .part(&Row::noise, noise_columns())
      .text("estimator", &Row::estimator)
      .text("leave_below", threshold<Row>(&scoring::Hysteresis::leave_below))
      .text("return_above", threshold<Row>(&scoring::Hysteresis::return_above));
}

Columns<scoring::OperatingScore> score_columns() {
  using Score = scoring::OperatingScore;
  return Columns<Score>()
      .metric("balanced_accuracy", [](const Score& s) { return s.points.balanced_accuracy(); })
      .metric("success", [](const Score& s) { return s.points.success(); })
      .metric("extra_switches_per_minute", &Score::extra_switches_per_minute)
      .metric("false_takeoffs_per_minute", &Score::false_takeoffs_per_minute)
      .metric("takeoff_recall", &Score::takeoff_recall)
      .metric("takeoff_error_ms", [](const Score& s) { return 1e3 * s.takeoff_error(); })
      .count("extra_switches", &Score::extra_switches)
      .count("flights", &Score::flights);
}

Columns<OperatingRow> row_columns() {
  return Columns<OperatingRow>()
      .text("simulator", &OperatingRow::simulator)
      .text("scenario", &OperatingRow::scene)
      .as("scene")
      .and_then(point_columns<OperatingRow>())
      .part(&OperatingRow::score, score_columns());
}

Columns<OperatingMean> mean_columns() {
  using Mean = OperatingMean;
  return point_columns<Mean>()
      .metric("balanced_accuracy", &Mean::balanced_accuracy)
      .metric("extra_switches_per_minute", &Mean::extra_switches_per_minute)
      .metric("false_takeoffs_per_minute", &Mean::false_takeoffs_per_minute)
      .metric("takeoff_error_ms", [](const Mean& mean) { return 1e3 * mean.takeoff_error; })
      .metric("extra_switches_per_flight", &Mean::extra_switches_per_flight)
      .flag("on_front", &Mean::is_on_front);
}

std::string switches_text(double per_minute) {
  return fmt::format("{:.{}f}", per_minute, per_minute < 10.0 ? 1 : 0);
}

/// Limits on extra switches per minute.
constexpr std::array limits = {30.0, 10.0, 3.0, 1.0};

/// Balanced accuracy of an estimator's own decision, then of the best thresholds within each limit.
std::vector<std::string> short_row(const OperatingMean& own,
                                   const std::vector<OperatingMean>& means,
                                   const Experiment& experiment) {
  std::vector<std::string> cells = {estimator_title_in(experiment, own.estimator),
                                    fmt::format("{:.4f} ({})", own.balanced_accuracy,
                                                switches_text(own.extra_switches_per_minute))};
  for (const double limit : limits) {
    double best = -1.0;
    for (const OperatingMean& mean : means) {
      const bool counts = mean.is_on_front && mean.estimator == own.estimator &&
                          mean.noise == own.noise && mean.extra_switches_per_minute <= limit;
      if (counts) best = std::max(best, mean.balanced_accuracy);
    }
    cells.push_back(best < 0.0 ? "-" : fmt::format("{:.4f}", best));
  }
  return cells;
}

}  // namespace

void write_tables(const std::vector<OperatingRow>& rows, const std::vector<OperatingMean>& means,
                  const RunDirectory& directory) {
  directory.write_table("operating_points_by_scene.csv", row_columns(), rows);
  directory.write_table("operating_points.csv", mean_columns(), means);
}

std::string operating_points_text(const std::vector<OperatingMean>& means,
                                  const Experiment& experiment) {
  std::string text = fmt::format(
      "Balanced accuracy, mean over scenes and engines, of the best thresholds of P(contact) by "
      "limit on extra switches per minute ({}); own decision: its extra switches per minute in "
      "brackets\n",
      labels_text(experiment));
  for (const noise::NoiseCell& cell : experiment.highlights) {
    Table table{{noise_text(cell), "own decision"}, {}};
    for (const double limit : limits) table.header.push_back(fmt::format("≤ {:.0f}", limit));
    for (const OperatingMean& mean : means) {
      if (!mean.thresholds && mean.noise == cell)
        table.rows.push_back(short_row(mean, means, experiment));
    }
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

}  // namespace touchdown::experiments
