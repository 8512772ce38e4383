#include "experiments/studies/operating_points/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/tables/table.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

namespace {

/// The thresholds as cells; empty for an estimator's own decision.
std::vector<std::string> cells_of(const std::optional<scoring::Hysteresis>& thresholds) {
  if (!thresholds) return {"", ""};
  return {exact(thresholds->leave_below), exact(thresholds->return_above)};
}

Table table_of(const std::vector<OperatingRow>& rows) {
  Table table{{"simulator", "scenario", "torque_noise_nm", "accelerometer_noise_mps2", "estimator",
               "leave_below", "return_above", "balanced_accuracy", "success",
               "extra_switches_per_minute", "false_takeoffs_per_minute", "takeoff_recall",
               "takeoff_error_ms", "extra_switches", "flights"},
              {}};
  for (const OperatingRow& row : rows) {
    const scoring::OperatingScore& score = row.score;
    std::vector<std::string>& cells =
        table.rows.emplace_back(std::vector{row.simulator, row.scene, exact(row.noise.torque),
                                            exact(row.noise.accelerometer), row.estimator});
    for (std::string& cell : cells_of(row.thresholds)) cells.push_back(std::move(cell));
    for (const double value : {score.points.balanced_accuracy(), score.points.success(),
                               score.extra_switches_per_minute(), score.false_takeoffs_per_minute(),
                               score.takeoff_recall(), 1e3 * score.takeoff_error()}) {
      cells.push_back(metric(value));
    }
    cells.push_back(std::to_string(score.extra_switches));
    cells.push_back(std::to_string(score.flights));
  }
  return table;
}

Table table_of(const std::vector<OperatingMean>& means) {
  Table table{
      {"torque_noise_nm", "accelerometer_noise_mps2", "estimator", "leave_below", "return_above",
       "balanced_accuracy", "extra_switches_per_minute", "false_takeoffs_per_minute",
       "takeoff_error_ms", "extra_switches_per_flight", "on_front"},
      {}};
  for (const OperatingMean& mean : means) {
    std::vector<std::string>& cells = table.rows.emplace_back(
        std::vector{exact(mean.noise.torque), exact(mean.noise.accelerometer), mean.estimator});
    for (std::string& cell : cells_of(mean.thresholds)) cells.push_back(std::move(cell));
    for (const double value :
         {mean.balanced_accuracy, mean.extra_switches_per_minute, mean.false_takeoffs_per_minute,
          1e3 * mean.takeoff_error, mean.extra_switches_per_flight}) {
      cells.push_back(metric(value));
    }
    cells.emplace_back(mean.is_on_front ? "1" : "0");
  }
  return table;
}

std::string switches_text(double per_minute) {
  return fmt::format("{:.{}f}", per_minute, per_minute < 10.0 ? 1 : 0);
}

/// Limits on extra switches per minute.
constexpr std::array limits = {30.0, 10.0, 3.0, 1.0};

/// Balanced accuracy of an estimator's own decision, then of the best thresholds within each limit.
std::vector<std::string> short_row(const OperatingMean& own,
                                   const std::vector<OperatingMean>& means) {
  std::vector<std::string> cells = {estimator_title(own.estimator),
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
  directory.write_table("operating_points_by_scene.csv", table_of(rows));
  directory.write_table("operating_points.csv", table_of(means));
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
      if (!mean.thresholds && mean.noise == cell) table.rows.push_back(short_row(mean, means));
    }
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

}  // namespace touchdown::experiments
