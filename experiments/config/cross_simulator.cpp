#include "experiments/config/cross_simulator.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/fields.hpp"

namespace touchdown::experiments {

namespace {

/// Names that the experiment itself must have.
void describe_subset(Fields& fields, std::string_view key, const std::vector<std::string>& known,
                     std::vector<std::string>& names) {
  fields(key, names);
  for (const std::string& name : names) {
    fields.check(std::find(known.begin(), known.end(), name) != known.end(), key,
                 fmt::format("'{}' is not one of the experiment's: {}{}", name,
                             fmt::join(known, ", "), did_you_mean(name, known)));
  }
}

}  // namespace

static void describe(Fields& fields, Factor& factor, const std::vector<std::string>& simulators) {
  fields("name", factor.name);
  fields.require("key", factor.key);
  if (!fields.present("name", true)) factor.name = factor.key;
  fields.require("values", factor.values);
  fields.check(!factor.values.empty(), "values", "expected at least one number");
  describe_subset(fields, "simulators", simulators, factor.simulators);
  if (fields.reading() && factor.simulators.empty()) factor.simulators = simulators;
}

void describe(Fields& section, CrossSimulatorConfig& config, const ComparedRuns& runs) {
  section.within("sensitivity", [&](Fields& fields) {
    if (fields.reading())
      config.sensitivity_runs = std::min(config.sensitivity_runs, runs.test_runs);
    fields("runs", config.sensitivity_runs, 1, 100'000);
    fields.check(config.sensitivity_runs <= runs.test_runs, "runs",
                 fmt::format("expected at most test.runs, {}", runs.test_runs));
    fields.list_if_any("factors", config.factors, runs.simulators);
  });
  section.within("verdict", [&](Fields& fields) {
    fields("largest_loss", config.verdict.largest_loss, 0.0, 1.0);
    fields("smallest_gain", config.verdict.smallest_gain, -1.0, 1.0);
    describe_subset(fields, "demanded", runs.estimators, config.verdict.demanded);
  });
  section.within("overlay", [&](Fields& fields) {
    fields("run", config.overlay.run, 0, runs.test_runs - 1);
    fields("drop", config.overlay.drop, 0, 1000);
  });
}

}  // namespace touchdown::experiments
