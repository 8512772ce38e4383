#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/evaluation/summary.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/value_figure.hpp"
#include "experiments/studies/registry.hpp"
#include "noise/sensor_profile.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// A disturbance of the sensors that is varied, with all others unchanged.
struct SensorFactor {
  std::string key;             ///< a key of `noise::with_value`
  std::vector<double> values;  ///< in its own unit
};

/// The section `sweep`: disturbances that are varied, one at a time.
struct SensorSweepConfig {
  std::vector<SensorFactor> factors;
};

/// A mapping of keys to lists of values.
void describe(Fields& fields, SensorSweepConfig& config, const Experiment& /*experiment*/) {
  std::vector<SensorFactor>& factors = config.factors;
  if (fields.documenting()) factors = {{"SENSOR.DISTURBANCE", {}}};
  if (fields.reading()) {
    for (const auto& entry : fields.node()) factors.push_back({entry.first.as<std::string>(), {}});
  }
  for (SensorFactor& factor : factors) {
    fields.in_line(factor.key, factor.values)
        .fallback("none")
        .doc("Values of a disturbance of the sensors, such as `torque.bias` or `delay`.");
    fields.check(!factor.values.empty(), factor.key, "expected at least one number");
    fields.check(factor.key, [&] {
      for (const double value : factor.values) noise::with_value({}, factor.key, value);
    });
  }
}

struct SensorVariation {
  std::string key;
  double value = 0.0;
};

std::string name_of(const SensorVariation& variation) {
  return fmt::format("{}={}", variation.key, exact(variation.value));
}

/// Every value of every disturbance, in the order of the file.
std::vector<SensorVariation> sensor_variations(const Experiment& experiment) {
  std::vector<SensorVariation> all;
  for (const SensorFactor& factor : experiment.studies.at<SensorSweepConfig>().factors) {
    for (const double value : factor.values) all.push_back({factor.key, value});
  }
  return all;
}

constexpr std::array shown_metrics = {
    "success",        "no_contact_precision",      "no_contact_recall",  "takeoff_recall",
    "landing_recall", "false_takeoffs_per_minute", "takeoff_latency_ms", "landing_latency_ms"};

/// One estimator at one value, both wheels added.
struct SweepRow {
  SensorVariation variation;
  ScoreSummary score;

  const std::string& simulator() const { return score.condition.test_simulator; }
  const std::string& estimator() const { return score.condition.estimator; }
};

/// Rows in the order of `sensor_variations`, then by engine.
std::vector<SweepRow> sweep_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<SweepRow> rows;
  for (const SensorVariation& variation : sensor_variations(experiment)) {
    const auto group = evaluation.plan.group_called(name_of(variation)).value();
    const CollectedCounts counts =
        collect(evaluation.plan, evaluation.plan.runs_in(group), evaluation.saved);
    for (ScoreSummary& summary : summarise(counts.scored, {&experiment.highlights.front(), 1},
                                           experiment.intervals.bootstrap)) {
      if (summary.view != scoring::scored_views().front()) continue;
      rows.push_back({variation, std::move(summary)});
    }
  }
  return rows;
}

Columns<SweepRow> sweep_columns() {
  Columns<SweepRow> columns;
  columns.text("simulator", &SweepRow::simulator)
      .text("disturbance", [](const SweepRow& row) { return row.variation.key; })
      .level("value", [](const SweepRow& row) { return row.variation.value; })
      .text("estimator", &SweepRow::estimator);
  for (const char* const name : shown_metrics) {
    columns.interval(name, [name](const SweepRow& row) { return row.score[name]; });
  }
  return columns.count("takeoffs",
                       [](const SweepRow& row) { return row.score.total.takeoff.events; });
}

/// For the terminal: a table for every disturbance and engine.
std::string sweep_text(const std::vector<SweepRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format(
      "Success rate by sensor disturbance ({}{}; {}); estimators are fitted without the "
      "disturbance\n",
      noise_text(experiment.highlights.front()), setup_caption(experiment),
      intervals_text(experiment));
  const auto engine_and_disturbance = [](const SweepRow& row) {
    return std::pair(row.variation.key, row.simulator());
  };
  for (const auto& [key, alike] : group_by(rows, engine_and_disturbance)) {
    TextTable table = pivot(
        alike, [&](const SweepRow& row) { return estimator_title_in(experiment, row.estimator()); },
        [](const SweepRow& row) { return exact(row.variation.value); },
        [](const SweepRow& row) { return with_interval(row.score["success"]); });
    table.header.front() = fmt::format("{}, {}", key.first, key.second);
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

/// Success rate over each disturbance: a figure for every engine, `sensor_sweep_<engine>`.
std::vector<FigureSpec> sweep_figures(const Table& sweep, const Experiment& experiment) {
  std::vector<FigureSpec> specs;
  for (const std::string& simulator : experiment.simulators) {
    FigureSpec spec = accuracy_by_value(sweep, "sensor_sweep", "disturbance", "value (SI units)",
                                        simulator, experiment);
    spec.title = fmt::format("Success rate by sensor disturbance: {}",
                             simulators::simulator_title(simulator));
    spec.caption = fmt::format(
        "Success rate of both wheels over the values of one disturbance at a time ({}{}; {}; {}). "
        "Estimators are fitted without the disturbance. Values are equally spaced; curves are "
        "shifted sideways a little.",
        noise_text(experiment.highlights.front()), setup_caption(experiment),
        labels_text(experiment), intervals_text(experiment));
    specs.push_back(std::move(spec));
  }
  return specs;
}

class SensorSweepStudy final : public SectionStudy<SensorSweepConfig> {
 public:
  /// An experiment without disturbances has no section.
  std::optional<StudySection> section() const override {
    StudySection section = optional_section<SensorSweepConfig>(
        "sweep", "Disturbances of the sensors that are varied, one at a time.");
    section.before = "noise";
    section.describe = [describe_config = section.describe](Fields& fields,
                                                            Experiment& experiment) {
      describe_config(fields, experiment);
      const auto* const config = experiment.studies.find<SensorSweepConfig>();
      if (config != nullptr && config->factors.empty()) {
        experiment.studies.erase<SensorSweepConfig>();
      }
    };
    return section;
  }

  /// Adds, for every value, the experiment's own test runs with that value in their sensors, at the
  /// first highlighted noise setting. Estimators keep the experiment's own fit. No run is simulated
  /// again.
  void plan(const RunRequest& request, Plan& plan) const override {
    const Experiment& experiment = request.experiment;
    const noise::SensorProfile own = plan.sensors.front().profile;
    const std::size_t first = plan.runs.size();
    for (const SensorVariation& variation : sensor_variations(experiment)) {
      const std::string name = name_of(variation);
      plan.sensors.push_back({name, noise::with_value(own, variation.key, variation.value)});
      plan_runs(request, RunRole::test, {.sensors = plan.sensors.size() - 1}, plan.groups.size(),
                plan);
      plan.groups.push_back(
          {name, own_engine_conditions(experiment), {}, {experiment.highlights.front()}});
    }
    plan_tasks(experiment, first, plan);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Experiment& experiment = evaluation.request.experiment;
    const std::vector<SweepRow> rows = sweep_rows(evaluation);
    const Table table = directory.write_table("sensor_sweep.csv", sweep_columns(), rows);
    return {{sweep_text(rows, experiment)}, {}, sweep_figures(table, experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> sensor_sweep_study() {
  return std::make_unique<const SensorSweepStudy>();
}

}  // namespace touchdown::experiments
