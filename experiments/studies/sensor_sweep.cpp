#include <array>
#include <vector>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/evaluation/query.hpp"
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

/// By value in the order of `sensor_variations`, then engine and estimator; both wheels added.
Table sweep_table(const Evaluation& evaluation) {
  using Score = scoring::Score;
  using Row = Scored<Score>;
  const Plan& plan = evaluation.plan;
  const Experiment& experiment = evaluation.request.experiment;
  const std::vector<SensorVariation> variations = sensor_variations(experiment);
  std::vector<CollectedCounts> counts;  // rows refer to them
  counts.reserve(variations.size());
  std::vector<Row> rows;
  for (std::size_t v = 0; v < variations.size(); ++v) {
    const std::size_t group = plan.group_called(name_of(variations[v])).value();
    counts.push_back(collect(plan, plan.runs_in(group), evaluation.saved));
    for (const auto& row :
         rows_of(counts.back().scored, plan.groups[group].scored, counts.back(), plan)) {
      rows.push_back({row.run, row.segment, row.condition, row.noise, v, row.score.wheels()});
    }
  }
  Query<Score> query;
  query.by.text("simulator", [](const Row& row) { return row.condition->test_simulator; })
      .text("disturbance", [&](const Row& row) { return variations[row.item].key; })
      .level("value", [&](const Row& row) { return variations[row.item].value; })
      .text("estimator", [](const Row& row) { return row.condition->estimator; });
  for (const char* const name : shown_metrics) {
    const scoring::Metric& metric = scoring::metrics()[scoring::metric_index(name)];
    query.statistics.push_back({metric.name, metric.of, metric.events});
  }
  query.totals.count("takeoffs", [](const Score& all) { return all.takeoff.events; });
  return answer(rows, query, experiment.intervals.bootstrap).table;
}

/// For the terminal: a table for every disturbance and engine.
std::string sweep_text(const Table& sweep, const Experiment& experiment) {
  std::string text = fmt::format(
      "Success rate by sensor disturbance ({}{}; {}); estimators are fitted without the "
      "disturbance\n",
      noise_text(experiment.highlights.front()), setup_caption(experiment),
      intervals_text(experiment));
  const auto disturbance_and_engine = [](const TableRow& row) {
    return fmt::format("{}, {}", row.text("disturbance"), row.text("simulator"));
  };
  for (const auto& [heading, alike] : group_by(sweep.all(), disturbance_and_engine)) {
    TextTable table = pivot(
        alike,
        [&](const TableRow& row) { return estimator_title_in(experiment, row.text("estimator")); },
        [](const TableRow& row) { return row.text("value"); },
        [](const TableRow& row) { return with_interval(row.interval("success")); });
    table.header.front() = heading;
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
    const Table& sweep = directory.write_measured("sensor_sweep.csv", sweep_table(evaluation));
    return {{sweep_text(sweep, experiment)}, {}, sweep_figures(sweep, experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> sensor_sweep_study() {
  return std::make_unique<const SensorSweepStudy>();
}

}  // namespace touchdown::experiments
