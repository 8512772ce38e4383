#include "experiments/benchmark/tables.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/table.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/tables/captions.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

bool is_fitted_scene(const Experiment& experiment, const std::string& file) {
  const std::vector<std::string>& fitted = experiment.fit.scenarios;
  return std::find(fitted.begin(), fitted.end(), file) != fitted.end() ||
         std::any_of(experiment.fit_pieces.begin(), experiment.fit_pieces.end(),
                     [&](const FitPieces& pieces) { return pieces.scenario == file; });
}

/// The runs of a group in one of the experiment's scenes.
std::vector<std::size_t> runs_in_scene(const Plan& plan, const Experiment& experiment,
                                       std::size_t group, std::size_t scene) {
  std::vector<std::size_t> runs = plan.runs_in(group);
  std::erase_if(runs, [&](std::size_t run) {
    return plan.runs[run].run / experiment.test.runs != static_cast<std::int64_t>(scene);
  });
  return runs;
}

/// Over runs: an estimator that is right in one of them is likely to be right throughout it.
Interval balanced_accuracy(const std::vector<scoring::RobotScore>& samples,
                           const scoring::BootstrapConfig& bootstrap) {
  std::vector<scoring::Classification> points;
  for (const scoring::RobotScore& sample : samples) points.push_back(sample.wheels().points);
  return scoring::bootstrap<scoring::Classification>(
             points, {[](const auto& all) { return all.balanced_accuracy(); }}, bootstrap)
      .front();
}

std::string fitted_on(const Condition& condition, const BenchmarkSetting& here,
                      const std::vector<BenchmarkSetting>& settings) {
  if (condition.is_fitted_here(here.setting.fit)) return "own";
  if (condition.fit_simulator != condition.test_simulator) return condition.fit_simulator;
  const auto there = std::find_if(
      settings.begin(), settings.end(),
      [&](const BenchmarkSetting& setting) { return setting.setting.fit == condition.fit; });
  return fmt::format("{} {}", there->robot, there->sensors);
}

/// What two fitted densities have in common, ∫ min(p, q), over the first one's grid: in contact or
/// in the air. Each is taken to be one on its own grid: kernels reach below a torque of zero.
double common_part(const MeasurementModel& first, const MeasurementModel& second,
                   double Likelihoods::*density, std::vector<double> LikelihoodGrids::*grid) {
  const auto share = [&](const LikelihoodGrids& grids) {
    const std::vector<double>& values = grids.*grid;
    return 1.0 / std::accumulate(values.begin(), values.end(), 0.0);
  };
  const LikelihoodGrids grids = first.grids();
  const LikelihoodGrids others = second.grids();
  const double area = grids.knee.step() * grids.wheel.step();
  const double other_area = others.knee.step() * others.wheel.step();
  const double one = share(grids);
  const double other = share(others) * area / other_area;
  double sum = 0.0;
  std::size_t i = 0;
  for (int wheel = 0; wheel < grids.wheel.count; ++wheel) {
    for (int knee = 0; knee < grids.knee.count; ++knee, ++i) {
      const Likelihoods there = second({grids.knee[knee], grids.wheel[wheel]});
      sum += std::fmin(one * (grids.*grid)[i], other * there.*density);
    }
  }
  return sum;
}

/// Of the first estimator that has densities.
Table overlap_table(const FittedModels& models, const Listened& listened) {
  Table table{{"simulator", "estimator", "robot", "sensors", "other_robot", "other_sensors",
               "no_contact_overlap", "contact_overlap"},
              {}};
  const Experiment& experiment = listened.request.experiment;
  const auto estimator = std::find_if(
      experiment.estimators.begin(), experiment.estimators.end(), [](const std::string& name) {
        return estimator_entry(name).fits() == ModelKind::measurement;
      });
  if (estimator == experiment.estimators.end()) return table;
  const auto settings = benchmark_settings(listened.request, listened.plan);
  for (const std::string& simulator : experiment.simulators) {
    const auto model = [&](const BenchmarkSetting& setting) -> const MeasurementModel& {
      return *models.at(simulator + setting.setting.fit).at(*estimator).measurement;
    };
    for (const BenchmarkSetting& first : settings) {
      for (const BenchmarkSetting& second : settings) {
        const auto common = [&](auto density, auto grid) {
          return metric(common_part(model(first), model(second), density, grid));
        };
        table.rows.push_back({simulator, *estimator, first.robot, first.sensors, second.robot,
                              second.sensors,
                              common(&Likelihoods::no_contact, &LikelihoodGrids::no_contact),
                              common(&Likelihoods::contact, &LikelihoodGrids::contact)});
      }
    }
  }
  return table;
}

double per_minute(std::int64_t count, std::int64_t microseconds) {
  return 60e6 * scoring::ratio(count, microseconds);
}

struct Column {
  const char* name;
  double (*of)(const BenchmarkRow& row);
};
constexpr std::array columns = {
    Column{"no_contact_precision",
           [](const BenchmarkRow& r) { return r.score.points.no_contact_precision(); }},
    Column{"no_contact_recall",
           [](const BenchmarkRow& r) { return r.score.points.no_contact_recall(); }},
    Column{"flight_f1", [](const BenchmarkRow& r) { return r.close.flights.f1(); }},
    Column{"takeoff_latency_median_ms",
           [](const BenchmarkRow& r) { return r.close.takeoff.absolute_percentile(0.5); }},
    Column{"landing_latency_median_ms",
           [](const BenchmarkRow& r) { return r.close.landing.absolute_percentile(0.5); }},
    Column{"extra_switches_per_minute",
           [](const BenchmarkRow& r) {
             return per_minute(r.close.extra_switches, r.score.scored_us);
           }},
    Column{"calibration_error",
           [](const BenchmarkRow& r) { return r.score.calibration.expected_error(); }},
    Column{"log_loss",
           [](const BenchmarkRow& r) {
             return r.close.log_loss / static_cast<double>(r.close.steps);
           }},
    Column{"success", [](const BenchmarkRow& r) { return r.score.points.success(); }},
    Column{"firm_balanced_accuracy",
           [](const BenchmarkRow& r) { return r.close.firm.balanced_accuracy(); }},
    Column{"false_takeoffs_per_minute",
           [](const BenchmarkRow& r) { return r.score.false_takeoffs_per_minute(); }},
    Column{"takeoff_latency_p90_ms",
           [](const BenchmarkRow& r) { return r.close.takeoff.absolute_percentile(0.9); }},
    Column{"landing_latency_p90_ms",
           [](const BenchmarkRow& r) { return r.close.landing.absolute_percentile(0.9); }},
    Column{"takeoff_early_share",
           [](const BenchmarkRow& r) { return r.close.takeoff.early_share(); }},
    Column{"landing_early_share",
           [](const BenchmarkRow& r) { return r.close.landing.early_share(); }}};

std::string title_of(const BenchmarkRow& row) {
  return fmt::format("{}, {}, sensors {}, {}", row.simulator, row.robot, row.sensors,
                     noise_text(row.noise));
}

/// Estimators down, scenes across; the worst scene and the mean beside them.
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
    line->push_back(fmt::format("{:.3f}", value));
    values[static_cast<std::size_t>(line - table.rows.begin())].push_back(value);
  }
  table.header.insert(table.header.end(), {"mean", "worst"});
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
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

}  // namespace

std::vector<BenchmarkRow> benchmark(const Listened& listened) {
  const Experiment& experiment = listened.request.experiment;
  const std::vector<std::string>& scenes = experiment.test.scenarios;
  std::vector<BenchmarkRow> rows;
  const auto settings = benchmark_settings(listened.request, listened.plan);
  for (const BenchmarkSetting& setting : settings) {
    for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
      const auto runs = runs_in_scene(listened.plan, experiment, setting.group, scene);
      const CollectedCounts counts = collect(listened.plan, runs, listened.saved);
      for (std::size_t c = 0; c < counts.scored.size(); ++c) {
        const ConditionScores& scored = counts.scored[c];
        const std::string& simulator = scored.condition.test_simulator;
        BenchmarkRow row{simulator,
                         setting.robot,
                         setting.sensors,
                         scenario_of(listened.request, scenes[scene]).scenario.name,
                         is_fitted_scene(experiment, scenes[scene]) ? "test" : "unseen",
                         {},
                         scored.condition.estimator,
                         fitted_on(scored.condition, setting, settings),
                         {},
                         {},
                         {}};
        for (const std::size_t index : runs) {
          const PlayedRun& run = listened.runs.at(index);
          if (run.plan.simulator != simulator) continue;
          ++row.runs;
          row.failed += run.failed() ? 1 : 0;
        }
        for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
          if (scored.samples[cell].empty()) continue;
          row.noise = experiment.highlights[cell];
          row.balanced_accuracy =
              balanced_accuracy(scored.samples[cell], experiment.intervals.bootstrap);
          row.score = scoring::sum(scored.samples[cell]).wheels();
          row.close = scoring::sum(counts.close[c].samples[cell]);
          rows.push_back(row);
        }
      }
    }
  }
  return rows;
}

void write_tables(const std::vector<BenchmarkRow>& rows, const FittedModels& models,
                  const Listened& listened, const RunDirectory& directory) {
  std::vector<std::string> last;
  for (const Column& column : columns) last.emplace_back(column.name);
  last.insert(last.end(), {"torque_noise_nm", "accelerometer_noise_mps2", "takeoffs", "runs",
                           "failed", "fitted_on"});
  Table table{
      header_with_intervals({"simulator", "robot", "sensors", "scene", "split", "estimator"},
                            {"balanced_accuracy"}, last),
      {}};
  for (const BenchmarkRow& row : rows) {
    std::vector<std::string> cells;
    for (const Column& column : columns) cells.push_back(metric(column.of(row)));
    cells.insert(cells.end(), {exact(row.noise.torque), exact(row.noise.accelerometer),
                               std::to_string(row.score.takeoff.events), std::to_string(row.runs),
                               std::to_string(row.failed), row.fitted_on});
    table.rows.push_back(row_with_intervals(
        {row.simulator, row.robot, row.sensors, row.scene, row.split, row.estimator},
        {row.balanced_accuracy}, cells));
  }
  directory.write_table("benchmark.csv", table);
  const Table overlaps = overlap_table(models, listened);
  if (!overlaps.rows.empty()) directory.write_table("density_overlap.csv", overlaps);
}

std::string benchmark_text(const std::vector<BenchmarkRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format("Balanced accuracy by scene ({})\n", labels_text(experiment));
  std::vector<std::string> titles;
  for (const BenchmarkRow& row : rows) {
    const std::string title = title_of(row);
    if (std::find(titles.begin(), titles.end(), title) == titles.end()) titles.push_back(title);
  }
  for (const std::string& title : titles) {
    std::vector<BenchmarkRow> alike;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(alike), [&](const BenchmarkRow& row) {
      return row.fitted_on == "own" && title_of(row) == title;
    });
    text += fmt::format("\n{}\n{}", title, to_text(scene_table(alike)));
    std::set<std::string> failures;
    for (const BenchmarkRow& row : alike) {
      if (row.failed == 0) continue;
      failures.insert(fmt::format("{} of {} in {}", row.failed, row.runs, row.scene));
    }
    if (!failures.empty()) {
      text += fmt::format("Runs that failed and are not scored: {}\n", fmt::join(failures, ", "));
    }
  }
  return text;
}

}  // namespace touchdown::experiments
