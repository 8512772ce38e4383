#include "experiments/tables/scores.hpp"

namespace touchdown::experiments {

namespace {

const std::vector<std::string> setting_columns = {"simulator", "estimator", "torque_noise_nm",
                                                  "accelerometer_noise_mps2", "view"};

std::vector<std::string> setting(const ScoreSummary& summary) {
  return {summary.condition.test_simulator, summary.condition.estimator, exact(summary.cell.torque),
          exact(summary.cell.accelerometer), summary.view};
}

/// The setting, then metrics with their intervals, then whole numbers.
Table table_of(
    const std::vector<ScoreSummary>& summaries, const std::vector<std::string>& names,
    const std::vector<std::pair<std::string, std::int64_t (*)(const scoring::Score&)>>& counts) {
  Table table{setting_columns, {}};
  for (const std::string& name : names) {
    // The unit stays last: takeoff_latency_ms, takeoff_latency_low_ms.
    const bool in_ms = name.ends_with("_ms");
    const std::string stem = in_ms ? name.substr(0, name.size() - 3) : name;
    append_interval_columns(table.header, stem, in_ms ? "_ms" : "");
  }
  for (const auto& [name, of] : counts) table.header.push_back(name);
  for (const ScoreSummary& summary : summaries) {
    std::vector<std::string> row = setting(summary);
    for (const std::string& name : names) {
      append_interval(row, summary[name]);
    }
    for (const auto& [name, of] : counts) row.push_back(std::to_string(of(summary.total)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Table views_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(
      summaries,
      {"success", "contact_precision", "contact_recall", "no_contact_precision",
       "no_contact_recall"},
      {{"contact_steps", [](const scoring::Score& s) { return s.points.contact(); }},
       {"no_contact_steps", [](const scoring::Score& s) { return s.points.flight(); }}});
}

Table transitions_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(
      summaries, {"takeoff_precision", "takeoff_recall", "landing_precision", "landing_recall"},
      {{"takeoffs", [](const scoring::Score& s) { return s.takeoff.events; }},
       {"false_takeoffs", [](const scoring::Score& s) { return s.takeoff.false_alarms; }},
       {"landings", [](const scoring::Score& s) { return s.landing.events; }},
       {"false_landings", [](const scoring::Score& s) { return s.landing.false_alarms; }}});
}

Table latency_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(
      summaries,
      {"takeoff_latency_ms", "takeoff_latency_deviation_ms", "landing_latency_ms",
       "landing_latency_deviation_ms"},
      {{"takeoffs_detected", [](const scoring::Score& s) { return s.takeoff.detected; }},
       {"landings_detected", [](const scoring::Score& s) { return s.landing.detected; }}});
}

Table calibration_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(summaries, {"brier"},
                  {{"steps", [](const scoring::Score& s) { return s.calibration.points; }}});
}

Table reliability_table(const std::vector<ScoreSummary>& summaries) {
  Table table{setting_columns, {}};
  table.header.insert(table.header.end(), {"bin", "steps", "mean_probability"});
  append_interval_columns(table.header, "contact_frequency");
  for (const ScoreSummary& summary : summaries) {
    for (std::size_t b = 0; b < scoring::Calibration::bins; ++b) {
      const scoring::Calibration::Bin& bin = summary.total.calibration.bin[b];
      std::vector<std::string> row = setting(summary);
      row.insert(row.end(),
                 {std::to_string(b), std::to_string(bin.points), metric(bin.mean_probability())});
      append_interval(row, summary.contact_frequency[b]);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table differences_table(const std::vector<Difference>& differences) {
  Table table{
      {"simulator", "torque_noise_nm", "accelerometer_noise_mps2", "first", "second", "metric"},
      {}};
  append_interval_columns(table.header, "difference");
  for (const Difference& difference : differences) {
    for (std::size_t m = 0; m < scoring::metrics().size(); ++m) {
      table.rows.push_back({difference.simulator, exact(difference.cell.torque),
                            exact(difference.cell.accelerometer), difference.first,
                            difference.second, scoring::metrics()[m].name});
      append_interval(table.rows.back(), difference.metric[m]);
    }
  }
  return table;
}

}  // namespace touchdown::experiments
