#include <array>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/rows.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/evaluation/query.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/studies/registry.hpp"
#include "noise/sensor_profile.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The key of the study, of its table, and of its figures.
constexpr const char* vary_name = "vary";

/// Keys of sensors begin with this, such as `sensors.torque.bias`; the others are of scenarios.
constexpr std::string_view of_sensors = "sensors.";

/// A quantity that is varied, with all others unchanged.
struct VariedKey {
  std::string key;
  std::vector<double> values;  ///< in its own unit
};

struct VaryConfig {
  std::vector<VariedKey> keys;
};

/// The key of `noise::with_value`; empty for a key of scenarios.
std::string sensor_key(const std::string& key) {
  return key.starts_with(of_sensors) ? key.substr(of_sensors.size()) : std::string();
}

/// A mapping of keys to lists of values.
void describe(Fields& fields, VaryConfig& config, const Experiment& /*experiment*/) {
  std::vector<VariedKey>& keys = config.keys;
  if (fields.documenting()) keys = {{"KEY", {}}};
  if (fields.reading()) {
    for (const auto& entry : fields.node()) keys.push_back({entry.first.as<std::string>(), {}});
  }
  for (VariedKey& varied : keys) {
    fields.in_line(varied.key, varied.values)
        .fallback("none")
        .doc(
            "Values of a number of the test scenarios, such as `terrain.friction`, or of a "
            "disturbance of the sensors, such as `sensors.torque.bias`.");
    fields.check(!varied.values.empty(), varied.key, "expected at least one number");
    const std::string sensors = sensor_key(varied.key);
    if (sensors.empty()) continue;
    fields.check(varied.key, [&] {
      for (const double value : varied.values) noise::with_value({}, sensors, value);
    });
  }
}

std::string group_name(const std::string& key, double value) {
  return fmt::format("{}={}", key, exact(value));
}

/// Text and figures show the first.
constexpr std::array shown_metrics = {"event_f1",
                                      "extra_switches_per_minute",
                                      "long_errors_s_per_minute",
                                      "success",
                                      "no_contact_precision",
                                      "no_contact_recall",
                                      "takeoff_recall",
                                      "landing_recall",
                                      "false_takeoffs_per_minute",
                                      "takeoff_latency_ms",
                                      "landing_latency_ms"};

/// By value in the order of the file, then engine and estimator; both wheels added.
Table vary_table(const Evaluation& evaluation) {
  using Score = scoring::Score;
  using Row = Scored<Score>;
  struct Varied {
    std::string key;
    double value;
    std::map<std::string, int> failed = {};  ///< runs that fell, by engine
  };
  const Plan& plan = evaluation.plan;
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<Varied> all;
  std::vector<Row> rows;
  for (const auto& [key, values] : experiment.studies.at<VaryConfig>().keys) {
    for (const double value : values) {
      Varied varied{key, value};
      const auto runs = plan.runs_in(plan.group_called(group_name(key, value)).value());
      for (const std::size_t run : runs) {
        varied.failed[plan.runs[run].simulator] += evaluation.runs.at(run).failed() ? 1 : 0;
      }
      for (const auto& row : score_rows(runs, plan, evaluation.saved).scored) {
        rows.push_back(
            {row.run, row.segment, row.condition, row.noise, all.size(), row.score.wheels()});
      }
      all.push_back(std::move(varied));
    }
  }
  Query<Score> query;
  query.by.text("simulator", [](const Row& row) { return row.condition->test_simulator; })
      .text("key", [&](const Row& row) { return all[row.item].key; })
      .level("value", [&](const Row& row) { return all[row.item].value; })
      .text("estimator", [](const Row& row) { return row.condition->estimator; })
      .count("failed", [&](const Row& row) {
        return all[row.item].failed.at(row.condition->test_simulator);
      });
  for (const char* const name : shown_metrics) {
    const scoring::Metric& metric = scoring::metrics()[scoring::metric_index(name)];
    query.statistics.push_back({metric.name, metric.of, metric.events});
  }
  query.totals.count("takeoffs", [](const Score& sum) { return sum.takeoff.events; });
  query.runs = "runs";
  return answer(rows, query, experiment.intervals.bootstrap).table;
}

/// For the terminal: a table for every key and engine.
std::string vary_text(const Table& vary, const Experiment& experiment) {
  std::string text = fmt::format(
      "F1 of takeoffs and landings by varied quantity ({}{}; {}); estimators are fitted without "
      "the change\n",
      noise_text(experiment.highlights.front()), setup_caption(experiment),
      intervals_text(experiment));
  const auto key_and_engine = [](const TableRow& row) {
    return fmt::format("{}, {}", row.text("key"), row.text("simulator"));
  };
  for (const auto& [heading, alike] : group_by(vary.all(), key_and_engine)) {
    TextTable table = pivot(
        alike,
        [&](const TableRow& row) { return estimator_title_in(experiment, row.text("estimator")); },
        [](const TableRow& row) { return row.text("value"); },
        [](const TableRow& row) {
          const std::string fell =
              row.number("failed") > 0.0 ? fmt::format(" ({} fell)", row.text("failed")) : "";
          return with_interval(row.interval(shown_metrics.front())) + fell;
        });
    table.header.front() = heading;
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

/// F1 over each quantity: a figure for every engine, `vary_<engine>`.
std::vector<FigureSpec> vary_figures(const Table& vary, const Experiment& experiment) {
  std::vector<FigureSpec> specs;
  for (const std::string& simulator : experiment.simulators) {
    FigureSpec spec{.name = fmt::format("{}_{}", vary_name, simulator), .table = "vary.csv"};
    spec.where = {{"simulator", simulator}};
    spec.panels = groups_in(
        vary, "key", [](const auto& key) { return key; }, spec.where);
    spec.series = groups_in(vary, "estimator", titles_in(experiment), spec.where);
    spec.colour_order = experiment.estimators;
    spec.x = {.column = "value", .title = "value (SI units)", .scale = AxisScale::ordinal};
    spec.measures = {axis_with_interval(shown_metrics.front(), "F1 of takeoffs and landings")};
    spec.title = fmt::format("F1 by varied quantity: {}", simulators::simulator_title(simulator));
    spec.caption = fmt::format(
        "F1 of both wheels' takeoffs and landings within 20 ms, over the values of one quantity at "
        "a time ({}{}; {}; {}). "
        "Estimators are fitted without the change. Values are equally spaced; curves are "
        "shifted sideways a little.",
        noise_text(experiment.highlights.front()), setup_caption(experiment),
        labels_text(experiment), intervals_text(experiment));
    spec.alt = "F1 of takeoffs and landings." + values_text(spec, vary);
    specs.push_back(std::move(spec));
  }
  return specs;
}

class VaryStudy final : public SectionStudy<VaryConfig> {
 public:
  /// An experiment without keys has no section.
  std::optional<StudySection> section() const override {
    StudySection section = optional_section<VaryConfig>(
        vary_name,
        "Numbers of the test scenarios or of the sensors that are varied, one at a time.");
    section.before = "noise";
    section.describe = [describe_config = section.describe](Fields& fields,
                                                            Experiment& experiment) {
      fields.gone("sweep", "is now `vary`, with keys such as `sensors.dropout`");
      describe_config(fields, experiment);
      const auto* const config = experiment.studies.find<VaryConfig>();
      if (config != nullptr && config->keys.empty()) experiment.studies.erase<VaryConfig>();
    };
    return section;
  }

  /// Adds, for every value, the experiment's own test runs with that value, at the first
  /// highlighted noise setting. Estimators keep the experiment's own fit. A value of the sensors
  /// simulates no run again. Errors: `InputError` that names the key and the invalid value.
  void plan(const RunRequest& request, Plan& plan) const override {
    const Experiment& experiment = request.experiment;
    const noise::SensorProfile own = plan.sensors.front().profile;
    const std::size_t first = plan.runs.size();
    for (const auto& [key, values] : section_of(experiment).keys) {
      const std::string sensors = sensor_key(key);
      for (const double value : values) {
        const std::string name = group_name(key, value);
        RunSetup setup;
        if (sensors.empty()) {
          setup.change = {key, value};
        } else {
          setup.sensors = plan.sensors.size();
          plan.sensors.push_back({name, noise::with_value(own, sensors, value)});
        }
        try {
          plan_runs(request, RunRole::test, setup, plan.groups.size(), plan);
        } catch (const InputError& error) {
          throw InputError(fmt::format("{}: {}: {}", vary_name, name, error.what()));
        }
        plan.groups.push_back(
            {name, own_engine_conditions(experiment), {}, {experiment.highlights.front()}});
      }
    }
    plan_tasks(experiment, first, plan);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Experiment& experiment = evaluation.request.experiment;
    const Table& vary = directory.write_measured("vary.csv", vary_table(evaluation));
    return {{vary_text(vary, experiment)}, {}, vary_figures(vary, experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> vary_study() { return std::make_unique<const VaryStudy>(); }

}  // namespace touchdown::experiments
