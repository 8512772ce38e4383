#include "experiments/score_tables.hpp"

namespace touchdown {

namespace {

/// The setting, then metrics with their intervals, then whole numbers.
Table table_of(const std::vector<ScoreSummary>& summaries, const std::vector<std::string>& names,
               const std::vector<std::pair<std::string, std::int64_t (*)(const Score&)>>& counts) {
  Table table{{"simulator", "estimator", "torque_noise_nm", "accelerometer_noise_mps2", "view"},
              {}};
  for (const std::string& name : names) {
    // The unit stays last: takeoff_latency_ms, takeoff_latency_low_ms.
    const bool in_ms = name.ends_with("_ms");
    const std::string stem = in_ms ? name.substr(0, name.size() - 3) : name;
    for (const char* suffix : {"", "_low", "_high"}) {
      table.header.push_back(stem + suffix + (in_ms ? "_ms" : ""));
    }
  }
  for (const auto& [name, of] : counts) table.header.push_back(name);
  for (const ScoreSummary& summary : summaries) {
    std::vector<std::string> row = {summary.condition.test_simulator, summary.condition.estimator,
                                    exact(summary.cell.torque), exact(summary.cell.accelerometer),
                                    summary.view};
    for (const std::string& name : names) {
      const Interval& interval = summary[name];
      row.push_back(metric(interval.estimate));
      row.push_back(metric(interval.low));
      row.push_back(metric(interval.high));
    }
    for (const auto& [name, of] : counts) row.push_back(std::to_string(of(summary.total)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Table views_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(summaries,
                  {"success", "contact_precision", "contact_recall", "no_contact_precision",
                   "no_contact_recall"},
                  {{"contact_steps", [](const Score& s) { return s.points.contact(); }},
                   {"no_contact_steps", [](const Score& s) { return s.points.flight(); }}});
}

Table transitions_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(summaries,
                  {"takeoff_precision", "takeoff_recall", "landing_precision", "landing_recall"},
                  {{"takeoffs", [](const Score& s) { return s.takeoff.events; }},
                   {"false_takeoffs", [](const Score& s) { return s.takeoff.false_alarms; }},
                   {"landings", [](const Score& s) { return s.landing.events; }},
                   {"false_landings", [](const Score& s) { return s.landing.false_alarms; }}});
}

Table latency_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(summaries,
                  {"takeoff_latency_ms", "takeoff_latency_deviation_ms", "landing_latency_ms",
                   "landing_latency_deviation_ms"},
                  {{"takeoffs_detected", [](const Score& s) { return s.takeoff.detected; }},
                   {"landings_detected", [](const Score& s) { return s.landing.detected; }}});
}

Table calibration_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(summaries, {"brier"},
                  {{"steps", [](const Score& s) { return s.calibration.points; }}});
}

Table reliability_table(const std::vector<ScoreSummary>& summaries) {
  Table table{{"simulator", "estimator", "torque_noise_nm", "accelerometer_noise_mps2", "view",
               "bin", "steps", "mean_probability", "contact_frequency", "contact_frequency_low",
               "contact_frequency_high"},
              {}};
  for (const ScoreSummary& summary : summaries) {
    for (std::size_t b = 0; b < Calibration::bins; ++b) {
      const Calibration::Bin& bin = summary.total.calibration.bin[b];
      const Interval& frequency = summary.contact_frequency[b];
      table.rows.push_back({summary.condition.test_simulator, summary.condition.estimator,
                            exact(summary.cell.torque), exact(summary.cell.accelerometer),
                            summary.view, std::to_string(b), std::to_string(bin.points),
                            metric(bin.mean_probability()), metric(frequency.estimate),
                            metric(frequency.low), metric(frequency.high)});
    }
  }
  return table;
}

Table differences_table(const std::vector<Difference>& differences) {
  Table table{{"simulator", "torque_noise_nm", "accelerometer_noise_mps2", "first", "second",
               "metric", "difference", "difference_low", "difference_high"},
              {}};
  for (const Difference& difference : differences) {
    for (std::size_t m = 0; m < metrics().size(); ++m) {
      const Interval& interval = difference.metric[m];
      table.rows.push_back({difference.simulator, exact(difference.cell.torque),
                            exact(difference.cell.accelerometer), difference.first,
                            difference.second, metrics()[m].name, metric(interval.estimate),
                            metric(interval.low), metric(interval.high)});
    }
  }
  return table;
}

}  // namespace touchdown
