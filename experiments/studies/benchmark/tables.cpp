#include "experiments/studies/benchmark/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/files.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/json_table.hpp"

namespace touchdown::experiments {

namespace {

double per_minute(std::int64_t count, std::int64_t microseconds) {
  return 60e6 * scoring::ratio(count, microseconds);
}

struct BenchmarkColumn {
  const char* name;
  double (*of)(const BenchmarkRow& row);
};
constexpr std::array columns = {
    BenchmarkColumn{"no_contact_precision",
                    [](const BenchmarkRow& r) { return r.score.points.no_contact_precision(); }},
    BenchmarkColumn{"no_contact_recall",
                    [](const BenchmarkRow& r) { return r.score.points.no_contact_recall(); }},
    BenchmarkColumn{"flight_f1", [](const BenchmarkRow& r) { return r.extended.flights.f1(); }},
    BenchmarkColumn{
        "takeoff_latency_median_ms",
        [](const BenchmarkRow& r) { return r.extended.takeoff.absolute_percentile(0.5); }},
    BenchmarkColumn{
        "landing_latency_median_ms",
        [](const BenchmarkRow& r) { return r.extended.landing.absolute_percentile(0.5); }},
    BenchmarkColumn{"extra_switches_per_minute",
                    [](const BenchmarkRow& r) {
                      return per_minute(r.extended.extra_switches, r.score.scored_us);
                    }},
    BenchmarkColumn{"calibration_error",
                    [](const BenchmarkRow& r) { return r.score.calibration.expected_error(); }},
    BenchmarkColumn{"log_loss",
                    [](const BenchmarkRow& r) {
                      return r.extended.log_loss / static_cast<double>(r.extended.steps);
                    }},
    BenchmarkColumn{"success", [](const BenchmarkRow& r) { return r.score.points.success(); }},
    BenchmarkColumn{"loaded_balanced_accuracy",
                    [](const BenchmarkRow& r) { return r.extended.loaded.balanced_accuracy(); }},
    BenchmarkColumn{"false_takeoffs_per_minute",
                    [](const BenchmarkRow& r) { return r.score.false_takeoffs_per_minute(); }},
    BenchmarkColumn{
        "takeoff_latency_p90_ms",
        [](const BenchmarkRow& r) { return r.extended.takeoff.absolute_percentile(0.9); }},
    BenchmarkColumn{
        "landing_latency_p90_ms",
        [](const BenchmarkRow& r) { return r.extended.landing.absolute_percentile(0.9); }},
    BenchmarkColumn{"takeoff_early_share",
                    [](const BenchmarkRow& r) { return r.extended.takeoff.early_share(); }},
    BenchmarkColumn{"landing_early_share",
                    [](const BenchmarkRow& r) { return r.extended.landing.early_share(); }}};

/// Rows: estimators. Columns: scenes, then the mean and the worst scene of estimators that were
/// scored in every scene.
Table scene_table(std::span<const BenchmarkRow> rows) {
  Table table{{""}, {}};
  std::vector<std::vector<double>> values;
  for (const BenchmarkRow& row : rows) {
    if (row.estimator == rows.front().estimator) table.header.push_back(row.scene);
    const std::string title = estimator_title(row.estimator);
    auto line = std::find_if(table.rows.begin(), table.rows.end(),
                             [&](const auto& cells) { return cells.front() == title; });
    if (line == table.rows.end()) {
      table.rows.push_back({title});
      values.emplace_back();
      line = table.rows.end() - 1;
    }
    const double value = row.balanced_accuracy.estimate;
    const auto scene = std::find(table.header.begin(), table.header.end(), row.scene);
    line->resize(static_cast<std::size_t>(scene - table.header.begin()), "–");
    line->push_back(fmt::format("{:.3f}", value));
    values[static_cast<std::size_t>(line - table.rows.begin())].push_back(value);
  }
  const std::size_t scenes = table.header.size() - 1;
  table.header.insert(table.header.end(), {"mean", "worst"});
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (values[i].size() < scenes) {
      table.rows[i].resize(table.header.size(), "–");
      continue;
    }
    double mean = 0.0;
    double worst = 1.0;
    for (const double value : values[i]) {
      mean += value / static_cast<double>(values[i].size());
      worst = std::fmin(worst, value);
    }
    for (const double value : {mean, worst}) table.rows[i].push_back(fmt::format("{:.3f}", value));
  }
  return table;
}

Table rows_table(const std::vector<BenchmarkRow>& rows, double level) {
  std::vector<std::string> last;
  for (const BenchmarkColumn& column : columns) last.emplace_back(column.name);
  last.insert(last.end(), {"torque_noise_nm", "accelerometer_noise_mps2", "takeoffs", "runs",
                           "failed", "fitted_on", "refits"});
  Table table{
      header_with_intervals({"simulator", "robot", "sensors", "scene", "split", "estimator"},
                            {"balanced_accuracy"}, last),
      {}};
  for (const BenchmarkRow& row : rows) {
    std::vector<std::string> cells;
    for (const BenchmarkColumn& column : columns) cells.push_back(metric(column.of(row)));
    cells.insert(cells.end(),
                 {exact(row.noise.torque), exact(row.noise.accelerometer),
                  std::to_string(row.score.takeoff.events), std::to_string(row.runs),
                  std::to_string(row.failed), row.fitted_on, std::to_string(row.refits)});
    table.rows.push_back(row_with_intervals(
        {row.simulator, row.robot, row.sensors, row.scene, row.split, row.estimator},
        {interval_of(row.balanced_accuracy, level)}, cells));
  }
  return table;
}

/// The first columns of the two tables below.
const std::vector<std::string> setup_columns = {"robot", "sensors", "torque_noise_nm",
                                                "accelerometer_noise_mps2"};

std::vector<std::string> setup_cells(const Standings& standings) {
  return {standings.robot, standings.sensors, exact(standings.noise.torque),
          exact(standings.noise.accelerometer)};
}

template <typename... Texts>
std::vector<std::string> followed_by(std::vector<std::string> first, const Texts&... more) {
  (first.emplace_back(more), ...);
  return first;
}

Table standings_table(const std::vector<Standings>& all) {
  Table table{header_with_intervals(
                  followed_by(setup_columns, "estimator"), {"mean_balanced_accuracy"},
                  {"worst_balanced_accuracy", "worst_scene", "worst_simulator",
                   "is_not_significantly_worse", "log_loss_bits", "excess_log_loss_bits"}),
              {}};
  for (const Standings& standings : all) {
    for (const Standings::Entry& entry : standings.entries) {
      table.rows.push_back(
          row_with_intervals(followed_by(setup_cells(standings), entry.estimator), {entry.mean},
                             {metric(entry.worst), entry.worst_scene, entry.worst_simulator,
                              entry.is_not_significantly_worse ? "1" : "0", metric(entry.log_loss),
                              metric(entry.excess_log_loss)}));
    }
  }
  return table;
}

Table differences_table(const std::vector<Standings>& all) {
  Table table{
      header_with_intervals(followed_by(setup_columns, "scene", "first", "second"), {"difference"}),
      {}};
  for (const Standings& standings : all) {
    for (const Standings::Difference& pair : standings.differences) {
      table.rows.push_back(row_with_intervals(
          followed_by(setup_cells(standings), pair.scene, pair.first, pair.second), {pair.value}));
    }
  }
  return table;
}

std::string standings_text(const Standings& standings) {
  const bool has_upper_bound = !std::isnan(standings.entries.front().excess_log_loss);
  Table table{{"", "mean", "not significantly worse than the best", "worst", "in"}, {}};
  if (has_upper_bound) table.header.emplace_back("excess log loss (bits)");
  for (const Standings::Entry& entry : standings.entries) {
    table.rows.push_back({estimator_title(entry.estimator), with_interval(entry.mean),
                          entry.is_not_significantly_worse ? "yes" : "",
                          fmt::format("{:.3f}", entry.worst),
                          fmt::format("{}, {}", entry.worst_scene, entry.worst_simulator)});
    if (has_upper_bound) table.rows.back().push_back(fmt::format("{:.3f}", entry.excess_log_loss));
  }
  return fmt::format("\n{}, sensors {}, {}: mean over scenes and engines\n{}", standings.robot,
                     standings.sensors, noise_text(standings.noise), to_text(table));
}

/// Every scene of one engine, robot, sensors and noise.
std::string scenes_text(const Standings& standings, const std::string& simulator,
                        const std::vector<BenchmarkRow>& rows) {
  std::vector<BenchmarkRow> alike;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(alike), [&](const BenchmarkRow& row) {
    return row.fitted_on == "own" && row.simulator == simulator && row.robot == standings.robot &&
           row.sensors == standings.sensors && row.noise == standings.noise;
  });
  if (alike.empty()) return {};
  std::string text =
      fmt::format("\n{}, {}, sensors {}, {}\n{}", simulator, standings.robot, standings.sensors,
                  noise_text(standings.noise), to_text(scene_table(alike)));
  std::set<std::string> failures;
  for (const BenchmarkRow& row : alike) {
    if (row.failed == 0) continue;
    failures.insert(fmt::format("{} of {} in {}", row.failed, row.runs, row.scene));
  }
  if (!failures.empty()) {
    text += fmt::format("Failed runs, not scored: {}\n", fmt::join(failures, ", "));
  }
  return text;
}

}  // namespace

BenchmarkResult with_standings(std::vector<BenchmarkRow> rows, double level) {
  BenchmarkResult result{std::move(rows), {}};
  result.standings = standings(result.rows, level);
  return result;
}

void write_tables(const BenchmarkResult& result, double level, const RunDirectory& directory) {
  nlohmann::ordered_json json;
  const auto write = [&](const std::string& name, const char* key, const Table& table) {
    directory.write_table(name + ".csv", table);
    json[key] = json_of(table);
  };
  write("benchmark", "rows", rows_table(result.rows, level));
  write("benchmark_standings", "standings", standings_table(result.standings));
  write("benchmark_differences", "differences", differences_table(result.standings));
  write_atomically(directory.file("tables", "benchmark.json"), json.dump(1) + "\n");
}

std::string benchmark_text(const BenchmarkResult& result, const Experiment& experiment) {
  std::string text = fmt::format("Balanced accuracy by scene ({})\n", labels_text(experiment));
  const Standings& first = result.standings.front();
  for (const Standings& standings : result.standings) {
    text += standings_text(standings);
    if (standings.robot != first.robot || standings.sensors != first.sensors) continue;
    for (const std::string& simulator : experiment.simulators) {
      text += scenes_text(standings, simulator, result.rows);
    }
  }
  return text;
}

}  // namespace touchdown::experiments
