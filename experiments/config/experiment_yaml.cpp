#include "experiments/config/experiment_yaml.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/estimators/registry.hpp"
#include "scenarios/generation/generate.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

using HyperparametersByEstimator = std::map<std::string, HyperparameterValues>;

/// The section of each estimator.
static void describe_estimators(Fields& all, HyperparametersByEstimator& values,
                                const Experiment& experiment) {
  for (const std::string& name : all.documenting() ? estimator_names() : experiment.estimators) {
    if (!all.given(name, values.contains(name))) continue;
    if (all.documenting() && estimator_entry(name).hyperparameters.empty()) continue;
    HyperparameterValues& hyperparameters = values[name];
    const EstimatorEntry& entry = estimator_entry(name, experiment.external_estimators);
    const auto describe_own = [&](Fields& own) {
      for (const Hyperparameter& one : entry.hyperparameters) {
        if (!own.given(one.name, hyperparameters.contains(one.name))) continue;
        own(one.name, hyperparameters[one.name])
            .fallback(value_text(YAML::Node(one.value)))
            .doc(fmt::format("Tuning draws it from {:g} to {:g}.", one.lowest, one.highest));
      }
    };
    all.within(name, describe_own).doc("Hyperparameters of this estimator.");
    if (!all.documenting()) all.check(name, [&] { check_values(hyperparameters, entry); });
  }
}

/// Reads the values that a tuning chose and wrote, by engine. Those of other engines and estimators
/// than the experiment's are left out.
static void read_hyperparameters(const std::string& file, Experiment& experiment) {
  Fields fields(YamlDocument::load(find_resource(file)));
  fields.know("manifest");
  for (const std::string& engine : simulators::simulator_names()) {
    const auto& own = experiment.simulators;
    const bool is_own = std::find(own.begin(), own.end(), engine) != own.end();
    if (!fields.given(engine, false) || !is_own) continue;
    fields.within(engine, [&](Fields& of_engine) {
      for (const std::string& name : estimator_names()) of_engine.know(name);
      describe_estimators(of_engine, experiment.engine_hyperparameters[engine], experiment);
    });
  }
  fields.finish();
}

/// Describes the section `hyperparameters`: values by estimator, then name, also by engine, or the
/// file of a tuning.
static void describe_hyperparameters(Fields& fields, Experiment& experiment) {
  constexpr const char* key = "hyperparameters";
  auto& of_engines = experiment.engine_hyperparameters;
  if (!fields.given(key, !experiment.hyperparameters.empty() || !of_engines.empty())) return;
  const auto describe_all = [&](Fields& all) {
    std::string file;
    if (all.given("tuned", false) || all.documenting()) {
      all("tuned", file)
          .fallback("none")
          .doc("Values by engine that `fit.tuning` chose: `tables/hyperparameters.yaml` of a run.");
      if (!all.documenting()) all.check("tuned", [&] { read_hyperparameters(file, experiment); });
    }
    for (const std::string& engine : experiment.simulators) {
      const bool is_given = all.given(engine, of_engines.contains(engine));
      if (all.documenting() || !is_given) continue;
      all.within(engine, [&](Fields& of_engine) {
        describe_estimators(of_engine, of_engines[engine], experiment);
      });
    }
    describe_estimators(all, experiment.hyperparameters, experiment);
  };
  fields.within(key, describe_all)
      .fallback("none")
      .doc("Values instead of the estimators' defaults, also by engine; not beside `fit.tuning`.");
  fields.check(!experiment.tuning, key, "expected no fit.tuning beside it, which chooses them");
}

/// Names of scenarios, of which the drawn ones must be known.
static KeyNotes describe_names(Fields& fields, std::string_view key,
                               std::vector<std::string>& names) {
  const KeyNotes notes = fields(key, names);
  for (const std::string& name : names) {
    if (!scenarios::is_drawn(name)) continue;
    fields.check(key, [&] { (void)scenarios::generate_named(name); });
  }
  return notes;
}

/// Files and drawn scenarios. A written experiment has the names of both.
static void describe_scenarios(Fields& section, RunsConfig& runs) {
  describe_names(section, "files", runs.scenarios).doc("Scenario files, before the drawn ones.");
  std::optional<scenarios::Generation> generation;
  section.section("generate", generation).doc("Scenarios to draw (`touchdown generate`).");
  if (!generation || section.documenting()) return;
  for (const scenarios::GeneratedScenario& drawn : scenarios::generate(*generation)) {
    runs.scenarios.push_back(scenarios::drawn_name(drawn));
  }
}

static void describe(Fields& fields, RunsConfig& runs) {
  constexpr const char* key = "scenarios";
  fields.require(key);
  const bool is_section = fields.documenting() || (fields.reading() && fields.node()[key].IsMap());
  if (is_section) {
    fields.within(key, [&](Fields& section) { describe_scenarios(section, runs); })
        .type("list of texts, or section")
        .doc("Scenario files, or names of drawn scenarios such as drawn:kerbs_7_000.");
  } else {
    describe_names(fields, key, runs.scenarios);
  }
  fields.check(!runs.scenarios.empty(), "scenarios", "expected at least one scenario file");
  fields("runs", runs.runs, 1, 100'000).doc("Runs of each scenario.");
  fields("perturbed", runs.perturbed).doc("Whether perturbations are drawn from the seed.");
}

/// All runs of a scenario without perturbations are equal, so they count as one.
static void describe(Fields& fields, TuningConfig& tuning, const Experiment& experiment) {
  const RunsConfig& fit = experiment.fit;
  fields.require("trials", tuning.trials, 1, 10'000)
      .doc("Trials of each estimator; the first has its defaults.");
  fields("folds", tuning.folds, 2, 1000).doc("Folds of the fitted runs, for cross-validation.");
  fields("everywhere", tuning.everywhere)
      .doc("Whether a benchmark's other robots and sensors have trials of their own.");
  if (fields.present("noise", true)) {
    fields.list("noise", tuning.noise).doc("Noise settings of the trials.");
  }
  fields.check(!tuning.noise.empty(), "noise", "expected at least one noise setting");
  if (fields.given("fixed", !tuning.fixed.empty())) {
    own_estimators(fields, "fixed", experiment, tuning.fixed)
        .fallback("none")
        .doc("Estimators that keep their defaults.");
  }
  const std::size_t runs =
      fit.scenarios.size() * (fit.perturbed ? static_cast<std::size_t>(fit.runs) : 1);
  fields.finish();
  fields.check(static_cast<std::size_t>(tuning.folds) <= runs, "folds",
               fmt::format("expected at most the number of different fitted runs, {}", runs));
}

static void describe_fit(Fields& fit, Experiment& experiment) {
  describe(fit, experiment.fit);
  fit.section("tuning", experiment.tuning, experiment)
      .doc("The same number of trials for every ranked estimator with hyperparameters.");
  fit.optional("seed", experiment.fit_seed)
      .fallback("the experiment's")
      .doc("Seed of the fitted runs.");
}

/// The key of the study that alone has an estimator with this name; empty without one.
static std::string owner_of_estimator(const std::string& name) {
  for (const StudySection& study : study_sections()) {
    if (!study.estimators) continue;
    for (const EstimatorEntry& entry : study.estimators()) {
      if (entry.name == name) return study.key;
    }
  }
  return {};
}

/// Estimators that only some experiments have: those written in Python, if Python runs the
/// experiment, and those of a study, if the experiment has its section.
static void require_available(const Fields& fields, const Experiment& experiment) {
  if (!fields.reading()) return;
  const YAML::Node given = fields.node()["estimators"];
  if (!given || !given.IsSequence()) return;
  const std::vector<std::string> known = estimator_names(experiment.external_estimators);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i].IsScalar()) continue;
    const std::string& name = given[i].Scalar();
    const bool is_present = std::find(known.begin(), known.end(), name) != known.end();
    fields.check_item(is_present || !name.starts_with(python_prefix), "estimators", i,
                      fmt::format("'{}' is written in Python: run the experiment from there, by "
                                  "'python3 -m touchdown run' or touchdown.run",
                                  name));
    const std::string owner = is_present ? "" : owner_of_estimator(name);
    fields.check_item(owner.empty(), "estimators", i,
                      fmt::format("'{0}' belongs to the study '{1}': expected the section '{1}' "
                                  "beside it",
                                  name, owner));
  }
}

/// Makes the estimators that only the sections of this experiment have.
static void add_study_estimators(const Fields& fields, Experiment& experiment) {
  if (!fields.reading() || fields.documenting()) return;
  for (const StudySection& study : study_sections()) {
    if (!study.estimators || !fields.present(study.key, false)) continue;
    for (EstimatorEntry& entry : study.estimators()) {
      experiment.external_estimators.push_back(std::move(entry));
    }
  }
}

/// Describes the studies' sections that are written before one of the experiment's own keys.
static void describe_studies(Fields& fields, std::string_view before, Experiment& experiment) {
  for (const StudySection& study : study_sections()) {
    if (study.before != before) continue;
    study.describe(fields, experiment);
  }
}

static void describe(Fields& fields, Experiment& experiment) {
  describe_base(fields);
  fields.require("name", experiment.name).doc("Name of the run directory and in captions.");
  fields.check(is_name_word(experiment.name), "name", expected_name_word);
  fields("seed", experiment.seed).doc("Seed of all random draws.");
  fields.names("simulators", simulators::simulator_names(), experiment.simulators)
      .doc("Physics engines.");
  add_study_estimators(fields, experiment);
  require_available(fields, experiment);
  fields.names("estimators", estimator_names(experiment.external_estimators), experiment.estimators)
      .doc("Estimators, in the order of tables.");
  if (!fields.present("fit", true)) {
    // A misspelt `base` is a better reason than the keys that it would bring.
    for (const Key& key : experiment_keys()) fields.know(key.path.substr(0, key.path.find('.')));
    fields.finish();
  }
  fields.require("fit");
  fields.require("test");
  fields.within("fit", [&](Fields& fit) { describe_fit(fit, experiment); })
      .doc("Noiseless runs to which models are fitted.");
  describe_hyperparameters(fields, experiment);
  fields.section("test", experiment.test).doc("Runs for scoring; no model is fitted to them.");
  const auto file_if_any = [&](const char* key, std::string& file) {
    if (!fields.given(key, !file.empty())) return KeyNotes();
    const KeyNotes notes = fields(key, file);
    fields.check(!file.empty(), key, "expected a file");
    return notes;
  };
  file_if_any("robot", experiment.robot)
      .fallback("each scenario's own")
      .doc("Robot of all runs: an MJCF, or a YAML file about one.");
  file_if_any("sensors", experiment.sensors)
      .fallback("ideal sensors")
      .doc("Sensor profile of all runs.");
  describe_studies(fields, "noise", experiment);
  const noise::NoiseGridConfig& noise = experiment.noise;
  fields.section("noise", experiment.noise)
      .doc("The grid of white noise on the estimators' signals.");
  if (experiment.tuning) {
    for (noise::NoiseCell& cell : experiment.tuning->noise) cell = noise::as_on_grid(cell, noise);
  }
  fields.list("highlights", experiment.highlights, noise)
      .fallback("the first cell")
      .doc("Cells of the grid that are scored in full.");
  if (fields.reading() && experiment.highlights.empty()) {
    experiment.highlights = {
        noise::as_on_grid({noise.torque.front(), noise.accelerometer.front()}, noise)};
  }
  fields.section("labels", experiment.labels).doc("When a wheel counts as being in contact.");
  fields.section("scoring", experiment.scoring).doc("How predictions are compared with the truth.");
  fields.section("intervals", experiment.intervals).doc("Bootstrap intervals.");
  fields.section("video", experiment.video, experiment)
      .doc("The run that is plotted and filmed for every engine.");
  describe_drop_figures(fields, experiment);
  fields.choose("recordings", {"all", "pictured", "none"}, experiment.recordings)
      .doc(
          "Recordings that the run directory keeps. Without any, a run that was stopped or is "
          "repeated simulates again.");
  fields("paper_tables", experiment.paper_tables)
      .doc("Whether the paper's Tables I to III are printed for every highlight.");
  if (fields.reading()) {
    fields("workers", experiment.workers, 0, 4096)
        .doc("Threads; 0: one per core. They change no result.");
    fields.section("figures", experiment.figures).doc("How figures are printed.");
  }
  const bool draws = experiment.video.enabled || experiment.detail;
  fields.check(!draws || experiment.recordings != KeptRecordings::none, "recordings",
               "expected all or pictured: the video and the detail are drawn from them; none goes "
               "with video.enabled: false and without the detail");
  for (const StudySection& study : study_sections()) fields.know(study.key);
  describe_studies(fields, "", experiment);
}

static Experiment default_experiment() {
  Experiment defaults;
  defaults.fit = {.scenarios = {}, .runs = 1};
  defaults.test = {.scenarios = {}, .runs = 8};
  return defaults;
}

Experiment experiment_from_yaml(const YamlDocument& document,
                                std::vector<EstimatorEntry> external_estimators) {
  check_external_names(external_estimators);
  Experiment experiment = default_experiment();
  experiment.external_estimators = std::move(external_estimators);
  return from_yaml(document, std::move(experiment));
}

std::vector<Key> experiment_keys() { return documented_keys(default_experiment()); }

void require_files(const YamlDocument& document) {
  std::vector<std::string> keys = {"fit.scenarios",  "fit.scenarios.files",
                                   "test.scenarios", "test.scenarios.files",
                                   "robot",          "sensors"};
  for (const StudySection& section : study_sections()) {
    keys.insert(keys.end(), section.file_keys.begin(), section.file_keys.end());
  }
  require_resources(document, keys, [](const std::string& name) {
    if (!scenarios::is_drawn(name)) (void)find_resource(name);
  });
}

std::string to_yaml(const Experiment& experiment) { return YAML::Dump(to_node(experiment)) + "\n"; }

}  // namespace touchdown::experiments
