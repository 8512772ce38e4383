#include "experiments/studies/benchmark.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

static void describe(Fields& fields, BenchmarkConfig& benchmark, const Experiment& experiment) {
  const auto describe_files = [&](const char* key, std::vector<std::string>& files) {
    const KeyNotes notes = fields(key, files);
    for (auto file = files.begin(); file != files.end(); ++file) {
      fields.check(std::find(files.begin(), file, *file) == file, key,
                   fmt::format("'{}' appears twice", *file));
    }
    return notes;
  };
  describe_files("robots", benchmark.robots).doc("Files of further robots.");
  for (std::size_t i = 0; i < benchmark.robots.size(); ++i) {
    // Recordings are named after the robot's file.
    const std::string name = std::filesystem::path(benchmark.robots[i]).stem().string();
    fields.check_item(
        is_name_word(name), "robots", i,
        fmt::format("the file's name without extension, '{}': {}", name, expected_name_word));
  }
  describe_files("sensors", benchmark.sensors).doc("Files of further sensor profiles.");
  fields("transfer", benchmark.transfer)
      .doc("Whether fits on another robot, other sensors or the other engine are scored, too.");
  fields("refits", benchmark.refits, 0, 1000)
      .doc("Fits of ranked estimators repeated on resampled runs, for wider intervals.");
  fields("refits_everywhere", benchmark.refits_everywhere)
      .doc("Whether refits cover all robots and sensors, or the experiment's own.");
  fields("clips", benchmark.clips).doc("Whether the worst segment of every estimator is filmed.");
  if (!fields.given("table", !benchmark.table.empty())) return;
  own_estimators(fields, "table", experiment, benchmark.table)
      .fallback("all that are ranked")
      .doc("Estimators of `benchmark_unseen.md`.");
}

namespace {

/// "noise/profiles/harsh.yaml" → "harsh"; without a file: "ideal".
std::string short_name(const std::string& file) {
  return file.empty() ? "ideal" : std::filesystem::path(file).stem().string();
}

std::vector<std::string> and_own(std::string own, const std::vector<std::string>& others) {
  std::vector<std::string> all = {std::move(own)};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

/// Tables distinguish the files by these names.
void require_different(const std::vector<std::string>& files, const char* key) {
  for (auto file = files.begin(); file != files.end(); ++file) {
    const auto same = std::find_if(files.begin(), file, [&](const std::string& other) {
      return short_name(other) == short_name(*file);
    });
    if (same == file) continue;
    throw InputError(fmt::format("benchmark.{}: '{}' is there already{}", key, short_name(*file),
                                 same == files.begin() ? ": the experiment's own" : ""));
  }
}

template <typename Items, typename Is>
std::size_t index_of(const Items& items, const Is& is) {
  return static_cast<std::size_t>(std::find_if(items.begin(), items.end(), is) - items.begin());
}

}  // namespace

std::vector<BenchmarkSetup> benchmark_setups(const RunRequest& request, const Plan& plan) {
  const Experiment& experiment = request.experiment;
  const auto& benchmark = experiment.studies.at<BenchmarkConfig>();
  const std::string own_robot =
      scenario_of(request, experiment.test.scenarios.front()).scenario.robot;
  const auto robots = and_own(own_robot, benchmark.robots);
  const auto sensors = and_own(experiment.sensors, benchmark.sensors);
  require_different(robots, "robots");
  require_different(sensors, "sensors");
  std::vector<BenchmarkSetup> all;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      BenchmarkSetup setup{short_name(robots[r]), short_name(sensors[s]), {}, 0};
      if (r > 0) setup.runs.robot = robots[r];
      if (!all.empty()) setup.runs.fit = fmt::format("_{}_{}", setup.robot, setup.sensors);
      if (s > 0) {
        setup.runs.sensors = index_of(plan.sensors, [&](const PlannedSensors& planned) {
          return planned.name == setup.sensors;
        });
      }
      setup.group =
          index_of(plan.groups, [&](const RunGroup& group) { return group.fit == setup.runs.fit; });
      all.push_back(std::move(setup));
    }
  }
  return all;
}

Measure extended_scores() {
  return measure_of_predictions<scoring::ExtendedScore>(
      std::string(extended_measure), [](const MeasuredPrediction& made) {
        std::vector<scoring::ExtendedScore> scores;
        if (made.condition.refit > 0) return scores;
        const RunSignals& run = made.run.signals;
        scores.push_back(scoring::extended_score(run.contact, run.normal_force, made.prediction,
                                                 run.info.control_period_us, made.run.scoring));
        return scores;
      });
}

namespace {

int refits_of(const BenchmarkConfig& benchmark, const std::string& fit) {
  return fit.empty() || benchmark.refits_everywhere ? benchmark.refits : 0;
}

/// Adds estimators that were fitted in one of the other setups, or in the other engine.
void add_transfers(const Experiment& experiment, const std::vector<BenchmarkSetup>& setups,
                   RunGroup& group) {
  for (const Condition& own : own_engine_conditions(experiment)) {
    if (!estimator_entry(experiment, own.estimator).fits()) continue;
    for (const BenchmarkSetup& other : setups) {
      if (other.runs.fit == group.fit) continue;
      group.conditions.push_back(
          {own.fit_simulator, own.test_simulator, own.estimator, other.runs.fit});
    }
    for (const std::string& engine : experiment.simulators) {
      const Condition transferred{engine, own.test_simulator, own.estimator, group.fit};
      const auto& all = group.conditions;
      if (std::find(all.begin(), all.end(), transferred) == all.end()) {
        group.conditions.push_back(transferred);
      }
    }
  }
  group.scores_transfer = true;
}

/// Adds the refits of the in-domain conditions of a group, after all others.
void add_refits(const Experiment& experiment, RunGroup& group) {
  const BenchmarkConfig& benchmark = experiment.studies.at<BenchmarkConfig>();
  const std::vector<Condition> all = group.conditions;
  for (const Condition& condition : all) {
    if (!condition.is_fitted_in_domain(group.fit)) continue;
    const EstimatorEntry& entry = estimator_entry(experiment, condition.estimator);
    if (!entry.fits()) continue;
    for (int refit = 1; refit <= refits_of(benchmark, group.fit); ++refit) {
      group.conditions.push_back(condition);
      group.conditions.back().refit = refit;
    }
  }
}

class BenchmarkStudy final : public SectionStudy<BenchmarkConfig> {
 public:
  std::optional<StudySection> section() const override {
    StudySection section = optional_section<BenchmarkConfig>(
        "benchmark", "Further robots and sensors; every scene is scored separately.");
    section.files = [](const Experiment& experiment) -> ExperimentFiles {
      const auto* const benchmark = experiment.studies.find<BenchmarkConfig>();
      if (benchmark == nullptr) return {};
      return {.robots = benchmark->robots, .sensors = benchmark->sensors};
    };
    section.file_keys = {"benchmark.robots", "benchmark.sensors"};
    return section;
  }

  /// Adds runs for fitting and for testing, for every setup but the experiment's own. All test runs
  /// are scored at the highlighted noise, with extended scores.
  void plan(const RunRequest& request, Plan& plan) const override {
    const Experiment& experiment = request.experiment;
    const auto& benchmark = experiment.studies.at<BenchmarkConfig>();
    for (const std::string& file : benchmark.sensors) {
      plan.sensors.push_back({short_name(file), profile_of(request.sensors, file)});
    }
    const std::vector<BenchmarkSetup> setups = benchmark_setups(request, plan);
    const std::size_t first = plan.runs.size();
    for (const BenchmarkSetup& setup : setups) {
      const std::string& fit = setup.runs.fit;
      plan.refits[fit] = refits_of(benchmark, fit);
      const RunSetup& where = setup.runs;
      if (where.fit.empty()) {
        add_measure(extended_scores(), plan.groups.front());
        if (benchmark.transfer) add_transfers(experiment, setups, plan.groups.front());
        add_refits(experiment, plan.groups.front());
        continue;
      }
      RunGroup group{fmt::format("{} {}", setup.robot, setup.sensors),
                     own_engine_conditions(experiment),
                     {},
                     experiment.highlights};
      for (Condition& condition : group.conditions) condition.fit = where.fit;
      add_measure(extended_scores(), group);
      group.fit = where.fit;
      if (benchmark.transfer) add_transfers(experiment, setups, group);
      add_refits(experiment, group);
      plan_runs(request, RunRole::fit, where, 0, plan);
      plan_runs(request, RunRole::test, where, plan.groups.size(), plan);
      plan.groups.push_back(std::move(group));
    }
    plan_tasks(experiment, first, plan);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::string text = write_benchmark(evaluation, directory);
    return {{text},
            {},
            standings_figures(directory.read_table("benchmark_standings.csv"),
                              evaluation.request.experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> benchmark_study() { return std::make_unique<const BenchmarkStudy>(); }

}  // namespace touchdown::experiments
