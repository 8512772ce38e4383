#include "experiments/tables/success.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

namespace {

const std::vector<std::function<double(const scoring::Classification&)>>& statistics() {
  static const std::vector<std::function<double(const scoring::Classification&)>> all = {
      &scoring::Classification::success, &scoring::Classification::contact_precision,
      &scoring::Classification::contact_recall, &scoring::Classification::no_contact_precision,
      &scoring::Classification::no_contact_recall};
  return all;
}

double always_contact_success(const std::vector<scoring::Classification>& samples) {
  scoring::Classification all;
  for (const scoring::Classification& sample : samples) all += sample;
  return scoring::ratio(all.contact(), all.points());
}

std::vector<std::string> setting(const CellSummary& summary) {
  return {summary.condition.test_simulator, summary.condition.estimator, exact(summary.cell.torque),
          exact(summary.cell.accelerometer)};
}

}  // namespace

std::vector<CellSummary> summarise(const std::vector<ConditionCounts>& counts,
                                   const std::vector<noise::NoiseCell>& cells,
                                   const scoring::BootstrapConfig& bootstrap_config) {
  std::vector<CellSummary> summaries(counts.size() * cells.size());
  tbb::parallel_for(std::size_t{0}, summaries.size(), [&](std::size_t i) {
    const ConditionCounts& condition = counts[i / cells.size()];
    const std::vector<scoring::Classification>& samples = condition.samples[i % cells.size()];
    const std::vector<Interval> intervals =
        scoring::bootstrap<scoring::Classification>(samples, statistics(), bootstrap_config);
    summaries[i] = {condition.condition, cells[i % cells.size()],
                    intervals[0],        intervals[1],
                    intervals[2],        intervals[3],
                    intervals[4],        always_contact_success(samples)};
  });
  return summaries;
}

Table success_table(const std::vector<CellSummary>& summaries) {
  Table table{{"simulator", "estimator", "torque_noise_nm", "accelerometer_noise_mps2"}, {}};
  append_interval_columns(table.header, "success");
  table.header.insert(table.header.end(),
                      {"always_contact_success", "knee_noise_nm", "wheel_noise_nm"});
  for (const CellSummary& summary : summaries) {
    std::vector<std::string> row = setting(summary);
    append_interval(row, summary.success);
    row.push_back(metric(summary.always_contact));
    row.push_back(exact(summary.cell.knee));
    row.push_back(exact(summary.cell.wheel));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table classification_table(const std::vector<CellSummary>& summaries) {
  Table table{{"simulator", "estimator", "torque_noise_nm", "accelerometer_noise_mps2"}, {}};
  for (const char* name :
       {"contact_precision", "contact_recall", "no_contact_precision", "no_contact_recall"}) {
    append_interval_columns(table.header, name);
  }
  table.header.insert(table.header.end(), {"knee_noise_nm", "wheel_noise_nm"});
  for (const CellSummary& summary : summaries) {
    std::vector<std::string> row = setting(summary);
    for (const Interval& interval : {summary.contact_precision, summary.contact_recall,
                                     summary.no_contact_precision, summary.no_contact_recall}) {
      append_interval(row, interval);
    }
    row.push_back(exact(summary.cell.knee));
    row.push_back(exact(summary.cell.wheel));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table cell_text_table(const std::vector<CellSummary>& summaries, const std::string& simulator,
                      const noise::NoiseCell& cell) {
  Table table{{"estimator", "success rate", "contact precision", "recall", "no contact precision",
               "recall"},
              {}};
  for (const CellSummary& summary : summaries) {
    if (summary.condition.test_simulator != simulator || !(summary.cell == cell)) continue;
    table.rows.push_back({estimator_entry(summary.condition.estimator).title,
                          with_interval(summary.success),
                          with_interval({summary.contact_precision.estimate, NAN, NAN}),
                          with_interval({summary.contact_recall.estimate, NAN, NAN}),
                          with_interval({summary.no_contact_precision.estimate, NAN, NAN}),
                          with_interval({summary.no_contact_recall.estimate, NAN, NAN})});
  }
  return table;
}

Table grid_text_table(const std::vector<CellSummary>& summaries, const std::string& simulator,
                      const std::string& estimator, const noise::NoiseGridConfig& noise) {
  Table table{{"torque noise"}, {}};
  for (const double level : noise.accelerometer) {
    table.header.push_back(fmt::format("{} m/s²", level));
  }
  for (const double torque : noise.torque) table.rows.push_back({fmt::format("{} N·m", torque)});
  for (const CellSummary& summary : summaries) {
    const Condition& who = summary.condition;
    if (who.test_simulator != simulator || who.estimator != estimator) continue;
    const auto row = std::find(noise.torque.begin(), noise.torque.end(), summary.cell.torque);
    const bool on_grid = row != noise.torque.end() &&
                         std::find(noise.accelerometer.begin(), noise.accelerometer.end(),
                                   summary.cell.accelerometer) != noise.accelerometer.end();
    if (!on_grid) continue;
    table.rows[static_cast<std::size_t>(row - noise.torque.begin())].push_back(
        fmt::format("{:.3f}{}", summary.success.estimate, summary.loses() ? "*" : ""));
  }
  return table;
}

}  // namespace touchdown::experiments
