#include "experiments/config/experiment.hpp"

#include "core/fields.hpp"
#include "experiments/estimators/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

static void describe(Fields& fields, RunsConfig& runs) {
  fields.require("scenarios", runs.scenarios);
  fields.check(!runs.scenarios.empty(), "scenarios", "expected at least one scenario file");
  fields("runs", runs.runs, 1, 100'000);
  fields("perturbed", runs.perturbed);
}

static void describe(Fields& fields, VideoConfig& video, const Experiment& experiment) {
  fields("enabled", video.enabled);
  fields("run", video.run, 0, experiment.test.runs - 1);
  if (fields.reading()) video.estimators = {experiment.estimators.front()};
  fields.names("estimators", experiment.estimators, video.estimators);
  fields("torque_noise", video.torque_noise, 0.0, 1e3);
  fields("accelerometer_noise", video.accelerometer_noise, 0.0, 1e3);
}

static void describe_cross_simulator(Fields& fields, Experiment& experiment) {
  constexpr const char* key = "cross_simulator";
  std::optional<CrossSimulatorConfig>& config = experiment.cross_simulator;
  if (!fields.present(key, config.has_value())) return;
  fields.know(key);
  fields.finish();
  if (fields.reading()) config.emplace();
  fields.check(experiment.simulators.size() == 2, "simulators", "expected two engines to compare");
  fields.section(key, *config,
                 ComparedRuns{experiment.simulators, experiment.estimators, experiment.test.runs});
}

static void describe(Fields& fields, Experiment& experiment) {
  const std::string& name = experiment.name;
  fields.require("name", experiment.name);
  fields.check(!name.empty() && name.find_first_of("/\\ \t\n.") == std::string::npos, "name",
               "expected a word that can name a folder");
  fields("seed", experiment.seed);
  fields.names("simulators", simulators::simulator_names(), experiment.simulators);
  fields.names("estimators", estimator_names(), experiment.estimators);
  fields.require("fit");
  fields.require("test");
  fields.within("fit", [&](Fields& fit) {
    describe(fit, experiment.fit);
    if (!fit.present("seed", experiment.fit_seed.has_value())) return;
    if (fit.reading()) experiment.fit_seed.emplace();
    fit("seed", *experiment.fit_seed);
  });
  fields.section("test", experiment.test);
  const noise::NoiseGridConfig& noise = experiment.noise;
  fields.section("noise", experiment.noise);
  fields.list("highlights", experiment.highlights, noise);
  if (fields.reading() && experiment.highlights.empty()) {
    experiment.highlights = {
        noise::with_encoder_noise({noise.torque.front(), noise.accelerometer.front()}, noise)};
  }
  fields.section("labels", experiment.labels);
  fields.section("scoring", experiment.scoring);
  fields.section("intervals", experiment.intervals);
  fields.section("video", experiment.video, experiment);
  describe_drop_figures(fields, experiment.detail, experiment.posterior,
                        {experiment.test.runs, noise, experiment.estimators});
  fields("paper_tables", experiment.paper_tables);
  if (fields.reading()) fields("workers", experiment.workers, 0, 4096);
  describe_cross_simulator(fields, experiment);
  if (fields.present("phase_study", experiment.phase_study)) {
    fields("phase_study", experiment.phase_study);
  }
}

Experiment experiment_from_yaml(const YamlDocument& document) {
  Experiment defaults;
  defaults.fit = {.scenarios = {}, .runs = 1, .perturbed = false};
  defaults.test = {.scenarios = {}, .runs = 8, .perturbed = true};
  return from_yaml(YamlMap(document), defaults);
}

std::string to_yaml(const Experiment& experiment) { return YAML::Dump(to_node(experiment)) + "\n"; }

}  // namespace touchdown::experiments
