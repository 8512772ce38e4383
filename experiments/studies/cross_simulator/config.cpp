#include "experiments/studies/cross_simulator/config.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* of_own_estimators = "list of the experiment's estimators";

/// Describes names that must be among the experiment's own.
KeyNotes describe_subset(Fields& fields, std::string_view key,
                         const std::vector<std::string>& known, std::vector<std::string>& names) {
  const KeyNotes notes = fields(key, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    fields.check_item(std::find(known.begin(), known.end(), names[i]) != known.end(), key, i,
                      fmt::format("'{}' is not one of the experiment's: {}{}", names[i],
                                  fmt::join(known, ", "), did_you_mean(names[i], known)));
  }
  return notes;
}

}  // namespace

static void describe(Fields& fields, Factor& factor, const std::vector<std::string>& simulators) {
  fields("name", factor.name).fallback("the key").doc("Name in tables.");
  fields.require("key", factor.key).doc("Dotted key of the scenario, such as `terrain.friction`.");
  if (!fields.present("name", true)) factor.name = factor.key;
  fields.require("values", factor.values).doc("Values of the key.");
  fields.check(!factor.values.empty(), "values", "expected at least one number");
  describe_subset(fields, "simulators", simulators, factor.simulators)
      .fallback("all")
      .doc("Engines with this quantity.");
  if (fields.reading() && factor.simulators.empty()) factor.simulators = simulators;
}

static void describe(Fields& section, CrossSimulatorConfig& config, const Experiment& experiment) {
  section
      .within("sensitivity",
              [&](Fields& fields) {
                if (fields.reading())
                  config.sensitivity_runs = std::min(config.sensitivity_runs, experiment.test.runs);
                fields("runs", config.sensitivity_runs, 1, 100'000)
                    .range("1 to test.runs")
                    .doc("Test runs per engine and value.");
                fields.check(config.sensitivity_runs <= experiment.test.runs, "runs",
                             fmt::format("expected at most test.runs, {}", experiment.test.runs));
                fields.list_if_any("factors", config.factors, experiment.simulators)
                    .doc("Quantities of the scenario that are varied, one at a time.");
              })
      .doc("How the results depend on quantities of the scenario.");
  section
      .within("verdict",
              [&](Fields& fields) {
                fields("largest_loss", config.verdict.largest_loss, 0.0, 1.0)
                    .doc("Limit of the accuracy lost by a fit in the other engine.");
                fields("smallest_gain", config.verdict.smallest_gain, -1.0, 1.0)
                    .doc("Accuracy that must be gained over constant contact.");
                describe_subset(fields, "demanded", experiment.estimators, config.verdict.demanded)
                    .type(of_own_estimators)
                    .doc("Estimators that must pass, or the run fails.");
              })
      .doc("What an estimator must achieve.");
  section
      .within("overlay",
              [&](Fields& fields) {
                fields("run", config.overlay.run, 0, experiment.test.runs - 1)
                    .range("0 to test.runs - 1")
                    .doc("Index of the test run.");
                fields("drop", config.overlay.drop, 0, 1000).doc("Index of the drop in the run.");
              })
      .doc("The drop that is plotted in both engines.");
}

StudySection cross_simulator_section() {
  constexpr const char* key = "cross_simulator";
  StudySection section =
      optional_section<CrossSimulatorConfig>(key, "How much the results depend on the engine.");
  section.describe = [describe_config = section.describe](Fields& fields, Experiment& experiment) {
    if (!fields.present(key, experiment.studies.has<CrossSimulatorConfig>())) return;
    fields.finish();
    fields.check(experiment.simulators.size() == 2, "simulators",
                 "expected two engines to compare");
    describe_config(fields, experiment);
    fields.check(experiment.recordings != KeptRecordings::none, "recordings",
                 "expected all or pictured: the cross-simulator overlay is drawn from them");
  };
  return section;
}

}  // namespace touchdown::experiments
