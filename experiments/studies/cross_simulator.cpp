#include "experiments/studies/cross_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/studies/registry.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/perturbation.hpp"
#include "scenarios/scenario_file.hpp"
#include "simulators/tyres.hpp"

namespace touchdown::experiments {

namespace {

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

static void describe(Fields& fields, CausesConfig& causes, const Experiment& experiment) {
  if (fields.reading()) causes.runs = std::min(causes.runs, experiment.test.runs);
  fields("runs", causes.runs, 1, experiment.test.runs)
      .range("1 to test.runs")
      .doc("Test runs per engine and setting.");
  fields.section("tyre", causes.tyre).doc("The contact model that both engines get.");
  fields.check(causes.tyre.law == models::Tyre::Law::spring_damper, "tyre",
               "expected 'law: spring_damper', which is the same in both engines");
  fields
      .within("tolerances",
              [&](Fields& each) {
                for (std::size_t q = 0; q < quantity_count; ++q) {
                  const QuantityName& name = name_of(q);
                  each(name.key, causes.tolerances[q], 0.0, 1e15).doc(name.unit, name.title);
                }
              })
      .doc("A quantity has converged if half the physics step changes it by no more than this.");
}

static void describe(Fields& section, CrossSimulatorConfig& config, const Experiment& experiment) {
  section.gone("sensitivity",
               "is now the section `vary` of the experiment, such as {terrain.friction: [0.5, 1]}");
  section
      .within("verdict",
              [&](Fields& fields) {
                fields("largest_loss", config.verdict.largest_loss, 0.0, 1.0)
                    .doc("Limit of the accuracy lost by a fit in the other engine.");
                fields("smallest_gain", config.verdict.smallest_gain, -1.0, 1.0)
                    .doc("Accuracy that must be gained over constant contact.");
                describe_subset(fields, "demanded", experiment.estimators, config.verdict.demanded)
                    .type("list of the experiment's estimators")
                    .doc("Estimators that must pass, or the run fails.");
              })
      .doc("What an estimator must achieve.");
  section.section("causes", config.causes, experiment)
      .doc("How much of the difference is edges, tyres, physics step and solver.");
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

namespace {

std::string group_name(const ChangedRuns& changed) {
  return changed.change.empty() ? "" : changed.change + " " + changed.simulator;
}

}  // namespace

void plan_changed_runs(const RunRequest& request, const ChangedRuns& changed,
                       const scenarios::Scenario& scenario, std::vector<Condition> conditions,
                       bool has_half_step, Plan& plan) {
  const Experiment& experiment = request.experiment;
  scenarios::CompiledScenes scenes;
  for (int i = 0; i < changed.runs; ++i) {
    scenarios::Scenario scene =
        experiment.test.perturbed ? scenarios::perturbed(scenario, experiment.seed, i) : scenario;
    if (has_half_step) {
      scene.simulation = simulators::with_half_steps(scene.simulation, *scenes.of(scene));
    }
    plan.runs.push_back({.role = RunRole::test,
                         .simulator = changed.simulator,
                         .scenario = std::move(scene),
                         .run = i,
                         .file = fmt::format("{}_{}_{}_{:03}.mpack", changed.simulator,
                                             scenario.name, changed.change, i),
                         .seed = experiment.seed,
                         .group = plan.groups.size()});
  }
  plan.groups.push_back(
      {group_name(changed), std::move(conditions), {experiment.highlights.front()}, {}});
}

std::vector<std::size_t> runs_of(const ChangedRuns& changed, const Plan& plan) {
  const std::size_t group = plan.group_called(group_name(changed)).value();
  std::vector<std::size_t> runs = plan.runs_in(group, changed.simulator);
  runs.resize(static_cast<std::size_t>(changed.runs));
  return runs;
}

namespace {

class CrossSimulatorStudy final : public SectionStudy<CrossSimulatorConfig> {
 public:
  std::optional<StudySection> section() const override {
    constexpr const char* key = "cross_simulator";
    StudySection section =
        optional_section<CrossSimulatorConfig>(key, "How much the results depend on the engine.");
    section.describe = [describe_config = section.describe](Fields& fields,
                                                            Experiment& experiment) {
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

  /// Estimators that were fitted in the other engine are evaluated, too. Every setting of `causes`
  /// gets a group of runs.
  void plan(const RunRequest& request, Plan& plan) const override {
    const Experiment& experiment = request.experiment;
    RunGroup& own = plan.groups.front();
    add_measure(facts_measure(), own);
    for (const Condition& condition : transfer_conditions(experiment)) {
      if (!condition.is_fitted_in_domain()) own.conditions.push_back(condition);
    }
    const std::size_t first = plan.runs.size();
    plan_causes(request, plan);
    plan_tasks(experiment, first, plan);
    plan.pictured.insert(section_of(request.experiment).overlay.run);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    return summarize_check(check_across_simulators(evaluation), directory);
  }
};

}  // namespace

std::unique_ptr<const Study> cross_simulator_study() {
  return std::make_unique<const CrossSimulatorStudy>();
}

}  // namespace touchdown::experiments
