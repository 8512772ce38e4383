#include "experiments/config/experiment.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "core/file_names.hpp"
#include "core/resources.hpp"
#include "experiments/estimators/registry.hpp"
#include "noise/sensors/factor.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// Describes names that must be among the experiment's own.
void describe_subset(Fields& fields, std::string_view key, const std::vector<std::string>& known,
                     std::vector<std::string>& names) {
  fields(key, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    fields.check_item(std::find(known.begin(), known.end(), names[i]) != known.end(), key, i,
                      fmt::format("'{}' is not one of the experiment's: {}{}", names[i],
                                  fmt::join(known, ", "), did_you_mean(names[i], known)));
  }
}

/// Limits of figures: more would not be readable.
constexpr std::size_t most_settings = 3;
constexpr std::size_t most_estimators = 6;
constexpr std::size_t most_panels = 4;

void describe_choice(Fields& fields, DropChoice& choice, const Experiment& experiment) {
  fields("run", choice.run, 0, experiment.test.runs - 1);
  fields.choose("wheels", {"both", "left", "right"}, choice.wheels);
  fields("drop", choice.drop, 0, 1000);
  fields.know("at");
  if (fields.present("at", choice.at.has_value())) {
    if (fields.reading()) choice.at.emplace();
    fields("at", *choice.at, 0.0, 1e6);
  }
  fields("seed", choice.seed, 0, experiment.noise.seeds - 1);
  fields("before", choice.before, 0.0, 10.0);
  fields("after", choice.after, 0.01, 10.0);
}

/// As many estimators as are readable, the paper's and the phase filter first.
std::vector<std::string> shown_by_default(const std::vector<std::string>& estimators) {
  std::vector<std::string> shown;
  const auto show = [&](const std::string& name) {
    const bool is_new = std::find(shown.begin(), shown.end(), name) == shown.end();
    if (is_new && shown.size() < most_estimators) shown.push_back(name);
  };
  for (const char* name : {"robust", "measurement_only", "reference", "phase"}) {
    if (std::find(estimators.begin(), estimators.end(), name) != estimators.end()) show(name);
  }
  for (const std::string& name : estimators) show(name);
  return shown;
}

}  // namespace

static void describe(Fields& fields, RunsConfig& runs) {
  fields.require("scenarios", runs.scenarios);
  fields.check(!runs.scenarios.empty(), "scenarios", "expected at least one scenario file");
  fields("runs", runs.runs, 1, 100'000);
  fields("perturbed", runs.perturbed);
}

static void describe(Fields& fields, TrainingSegments& segments) {
  fields.require("scenario", segments.scenario);
  fields("runs", segments.runs, 1, 100'000);
  fields("after", segments.after, 0.0, 1e4);
  fields("length", segments.length, 0.01, 1e4);
  fields.renamed("places", "offsets");
  fields("offsets", segments.offsets, 1, 1000);
}

/// All runs of a scenario without perturbations are equal, so they count as one.
static void describe(Fields& fields, TuningConfig& tuning, const RunsConfig& fit) {
  fields.require("trials", tuning.trials, 1, 10'000);
  fields("folds", tuning.folds, 2, 1000);
  fields("everywhere", tuning.everywhere);
  if (fields.present("noise", true)) fields.list("noise", tuning.noise);
  fields.check(!tuning.noise.empty(), "noise", "expected at least one noise setting");
  const std::size_t runs =
      fit.scenarios.size() * (fit.perturbed ? static_cast<std::size_t>(fit.runs) : 1);
  fields.finish();
  fields.check(static_cast<std::size_t>(tuning.folds) <= runs, "folds",
               fmt::format("expected at most the number of different fitted runs, {}", runs));
}

static void describe(Fields& fields, VideoConfig& video, const Experiment& experiment) {
  fields("enabled", video.enabled);
  fields("run", video.run, 0, experiment.test.runs - 1);
  if (fields.reading()) video.estimators = {experiment.estimators.front()};
  fields.names("estimators", experiment.estimators, video.estimators);
  fields("torque_noise", video.torque_noise, 0.0, 1e3);
  fields("accelerometer_noise", video.accelerometer_noise, 0.0, 1e3);
}

static void describe(Fields& fields, DetailConfig& detail, const Experiment& experiment) {
  fields.list("noise", detail.noise);
  fields.check(!detail.noise.empty() && detail.noise.size() <= most_settings, "noise",
               fmt::format("expected 1 to {} noise settings", most_settings));
  if (fields.reading()) detail.estimators = shown_by_default(experiment.estimators);
  fields.names("estimators", experiment.estimators, detail.estimators);
  fields.check(detail.estimators.size() <= most_estimators, "estimators",
               fmt::format("expected at most {} names", most_estimators));
  for (noise::NoiseCell& cell : detail.noise) {
    cell = noise::as_on_grid(cell, experiment.noise);
  }
}

static void describe(Fields& fields, PosteriorConfig& posterior, const Experiment& experiment) {
  if (fields.present("noise", true)) fields.section("noise", posterior.noise);
  posterior.noise = noise::as_on_grid(posterior.noise, experiment.noise);
}

/// A section that enables a figure if it is present, unless it has `enabled: false`.
template <typename Config>
static void describe_switched(Fields& parent, std::string_view key, std::optional<Config>& config,
                              const Experiment& experiment) {
  if (!parent.present(key, config.has_value())) return parent.know(key);
  bool enabled = true;
  if (parent.reading()) config.emplace();
  parent.within(key, [&](Fields& fields) {
    if (fields.reading()) fields("enabled", enabled);
    describe_choice(fields, config->choice, experiment);
    describe(fields, *config, experiment);
  });
  if (!enabled) config.reset();
}

static void describe(Fields& fields, Factor& factor, const std::vector<std::string>& simulators) {
  fields("name", factor.name);
  fields.require("key", factor.key);
  if (!fields.present("name", true)) factor.name = factor.key;
  fields.require("values", factor.values);
  fields.check(!factor.values.empty(), "values", "expected at least one number");
  describe_subset(fields, "simulators", simulators, factor.simulators);
  if (fields.reading() && factor.simulators.empty()) factor.simulators = simulators;
}

/// A mapping of keys to lists of values.
static void describe(Fields& fields, std::vector<SensorFactor>& factors) {
  if (fields.reading()) {
    for (const auto& entry : fields.node()) factors.push_back({entry.first.as<std::string>(), {}});
  }
  for (SensorFactor& factor : factors) {
    fields.in_line(factor.key, factor.values);
    fields.check(!factor.values.empty(), factor.key, "expected at least one number");
    fields.check(factor.key, [&] {
      for (const double value : factor.values) noise::with_value({}, factor.key, value);
    });
  }
}

static void describe(Fields& section, CrossSimulatorConfig& config, const Experiment& experiment) {
  section.within("sensitivity", [&](Fields& fields) {
    if (fields.reading())
      config.sensitivity_runs = std::min(config.sensitivity_runs, experiment.test.runs);
    fields("runs", config.sensitivity_runs, 1, 100'000);
    fields.check(config.sensitivity_runs <= experiment.test.runs, "runs",
                 fmt::format("expected at most test.runs, {}", experiment.test.runs));
    fields.list_if_any("factors", config.factors, experiment.simulators);
  });
  section.within("verdict", [&](Fields& fields) {
    fields("largest_loss", config.verdict.largest_loss, 0.0, 1.0);
    fields("smallest_gain", config.verdict.smallest_gain, -1.0, 1.0);
    describe_subset(fields, "demanded", experiment.estimators, config.verdict.demanded);
  });
  section.within("overlay", [&](Fields& fields) {
    fields("run", config.overlay.run, 0, experiment.test.runs - 1);
    fields("drop", config.overlay.drop, 0, 1000);
  });
}

static void describe(Fields& fields, BenchmarkConfig& benchmark) {
  const auto describe_files = [&](const char* key, std::vector<std::string>& files) {
    fields(key, files);
    for (auto file = files.begin(); file != files.end(); ++file) {
      fields.check(std::find(files.begin(), file, *file) == file, key,
                   fmt::format("'{}' appears twice", *file));
    }
  };
  describe_files("robots", benchmark.robots);
  describe_files("sensors", benchmark.sensors);
  fields("transfer", benchmark.transfer);
  fields("refits", benchmark.refits, 0, 1000);
  fields("refits_everywhere", benchmark.refits_everywhere);
  fields("clips", benchmark.clips);
}

static void describe(Fields& fields, OdometryStudyConfig& odometry) {
  fields.renamed("late", "delay");
  fields.in_line("delay", odometry.delay);
  for (auto delay = odometry.delay.begin(); delay != odometry.delay.end(); ++delay) {
    fields.check(*delay > 0.0 && *delay <= 1.0, "delay", "expected times between 0 and 1 s");
    fields.check(std::find(odometry.delay.begin(), delay, *delay) == delay, "delay",
                 fmt::format("{} appears twice", *delay));
  }
}

static void describe(Fields& fields, OperatingPointsConfig& config) {
  const auto describe_thresholds = [&](const char* key, std::vector<double>& thresholds) {
    fields.in_line(key, thresholds);
    fields.check(!thresholds.empty(), key, "expected at least one probability");
    fields.check(thresholds.empty() ||
                     (thresholds.front() > 0.0 && thresholds.back() < 1.0 &&
                      std::is_sorted(thresholds.begin(), thresholds.end(), std::less_equal<>())),
                 key, "expected increasing probabilities, none of them 0 or 1");
  };
  describe_thresholds("leave_below", config.leave_below);
  describe_thresholds("return_above", config.return_above);
  fields.check(config.leave_below.front() <= config.return_above.back(), "return_above",
               "expected a threshold of at least the lowest leave_below");
}

static void describe(Fields& fields, ClosedLoopScene& scene, const Experiment& experiment) {
  fields.require("scenario", scene.scenario);
  fields.know("key");
  fields.know("values");
  if (fields.present("key", !scene.key.empty()) || fields.present("values", false)) {
    fields.require("key", scene.key);
    fields.require("values", scene.values);
    fields.check(!scene.values.empty(), "values", "expected at least one number");
    fields.check(std::is_sorted(scene.values.begin(), scene.values.end(), std::less_equal<>()),
                 "values", "expected increasing numbers");
  }
  if (fields.present("noise", true)) fields.list("noise", scene.noise);
  fields.check(!scene.noise.empty(), "noise", "expected at least one noise setting");
  for (noise::NoiseCell& cell : scene.noise) cell = noise::as_on_grid(cell, experiment.noise);
  fields.renamed("late", "delay");
  fields.in_line("delay", scene.delay);
  fields.check(!scene.delay.empty() && scene.delay.front() >= 0.0 && scene.delay.back() <= 1.0 &&
                   std::is_sorted(scene.delay.begin(), scene.delay.end(), std::less_equal<>()),
               "delay", "expected increasing times from 0 to 1 s");
  const int varied = (scene.values.size() > 1 ? 1 : 0) + (scene.noise.size() > 1 ? 1 : 0) +
                     (scene.delay.size() > 1 ? 1 : 0);
  fields.check(varied <= 1, "scenario",
               "expected at most one varied quantity: values of a key, noise, or delay");
}

static void describe(Fields& fields, ClosedLoopFilm& film, const ClosedLoopConfig& config) {
  fields("scene", film.scene, 0, static_cast<int>(config.scenes.size()) - 1);
  const std::size_t points = points_of(config.scenes[static_cast<std::size_t>(film.scene)]);
  fields("point", film.point, 0, static_cast<int>(points) - 1);
  fields("run", film.run, 0, config.runs - 1);
  if (fields.reading()) film.law = config.laws.front();
  fields.choose("law", config.laws, film.law);
  if (fields.reading()) {
    film.contact = config.contact;
    film.contact.resize(std::min(most_panels, film.contact.size()));
  }
  fields.names("contact", config.contact, film.contact);
  fields.check(film.contact.size() <= most_panels, "contact",
               fmt::format("expected at most {} names", most_panels));
}

static void describe(Fields& fields, ClosedLoopConfig& config, const Experiment& experiment) {
  fields.names("laws", {"balancer", "soft_landing"}, config.laws);
  std::vector<std::string> contact_sources = {"truth", "always"};
  contact_sources.insert(contact_sources.end(), experiment.estimators.begin(),
                         experiment.estimators.end());
  if (fields.reading()) config.contact = contact_sources;
  fields.names("contact", contact_sources, config.contact);
  fields.require("scenes");
  fields.list("scenes", config.scenes, experiment);
  fields.check(!config.scenes.empty(), "scenes", "expected at least one scene");
  fields("runs", config.runs, 1, 100'000);
  fields.know("film");
  if (!fields.present("film", config.film.has_value())) return;
  if (fields.reading()) config.film.emplace();
  fields.within("film", [&](Fields& film) { describe(film, *config.film, config); });
}

/// By estimator, then name, as tuning chooses them.
static void describe_hyperparameters(Fields& fields, Experiment& experiment) {
  constexpr const char* key = "hyperparameters";
  fields.renamed("constants", key);
  fields.know(key);
  if (!fields.present(key, !experiment.hyperparameters.empty())) return;
  fields.within(key, [&](Fields& all) {
    for (const std::string& name : experiment.estimators) {
      all.know(name);
      if (!all.present(name, experiment.hyperparameters.contains(name))) continue;
      HyperparameterValues& hyperparameters = experiment.hyperparameters[name];
      all.within(name, [&](Fields& own) {
        for (const Hyperparameter& one :
             estimator_entry(name, experiment.external_estimators).hyperparameters) {
          own.know(one.name);
          if (!own.present(one.name, hyperparameters.contains(one.name))) continue;
          own(one.name, hyperparameters[one.name]);
        }
      });
    }
  });
  fields.check(!experiment.tuning, key, "expected no fit.tuning beside it, which chooses them");
}

static void describe_cross_simulator(Fields& fields, Experiment& experiment) {
  constexpr const char* key = "cross_simulator";
  std::optional<CrossSimulatorConfig>& config = experiment.cross_simulator;
  if (!fields.present(key, config.has_value())) return;
  fields.know(key);
  fields.finish();
  if (fields.reading()) config.emplace();
  fields.check(experiment.simulators.size() == 2, "simulators", "expected two engines to compare");
  fields.section(key, *config, experiment);
}

/// Estimators written in Python exist only in experiments that Python runs.
static void require_python(const Fields& fields, const Experiment& experiment) {
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
  }
}

static void describe(Fields& fields, Experiment& experiment) {
  fields.require("name", experiment.name);
  fields.check(is_name_word(experiment.name), "name", expected_name_word);
  fields("seed", experiment.seed);
  fields.names("simulators", simulators::simulator_names(), experiment.simulators);
  require_python(fields, experiment);
  fields.names("estimators", estimator_names(experiment.external_estimators),
               experiment.estimators);
  fields.require("fit");
  fields.require("test");
  fields.within("fit", [&](Fields& fit) {
    describe(fit, experiment.fit);
    fit.renamed("pieces", "segments");
    fit.list_if_any("segments", experiment.training_segments);
    fit.know("tuning");
    if (fit.present("tuning", experiment.tuning.has_value())) {
      if (fit.reading()) experiment.tuning.emplace();
      fit.section("tuning", *experiment.tuning, experiment.fit);
    }
    if (!fit.present("seed", experiment.fit_seed.has_value())) return;
    if (fit.reading()) experiment.fit_seed.emplace();
    fit("seed", *experiment.fit_seed);
  });
  describe_hyperparameters(fields, experiment);
  fields.section("test", experiment.test);
  const auto file_if_any = [&](const char* key, std::string& file) {
    fields.know(key);
    if (!fields.present(key, !file.empty())) return;
    fields(key, file);
    fields.check(!file.empty(), key, "expected a file");
  };
  file_if_any("robot", experiment.robot);
  file_if_any("sensors", experiment.sensors);
  fields.know("sweep");
  if (fields.present("sweep", !experiment.sweep.empty())) fields.section("sweep", experiment.sweep);
  const noise::NoiseGridConfig& noise = experiment.noise;
  fields.section("noise", experiment.noise);
  if (experiment.tuning) {
    for (noise::NoiseCell& cell : experiment.tuning->noise) cell = noise::as_on_grid(cell, noise);
  }
  fields.list("highlights", experiment.highlights, noise);
  if (fields.reading() && experiment.highlights.empty()) {
    experiment.highlights = {
        noise::as_on_grid({noise.torque.front(), noise.accelerometer.front()}, noise)};
  }
  fields.section("labels", experiment.labels);
  fields.section("scoring", experiment.scoring);
  fields.section("intervals", experiment.intervals);
  fields.section("video", experiment.video, experiment);
  describe_switched(fields, "detail", experiment.detail, experiment);
  describe_switched(fields, "posterior", experiment.posterior, experiment);
  const auto& names = experiment.estimators;
  fields.check(
      !experiment.posterior || std::find(names.begin(), names.end(), "phase") != names.end(),
      "posterior",
      "expected 'phase' among the experiment's estimators, or posterior.enabled: false");
  fields.choose("recordings", {"all", "pictured", "none"}, experiment.recordings);
  fields("paper_tables", experiment.paper_tables);
  if (fields.reading()) fields("workers", experiment.workers, 0, 4096);
  describe_cross_simulator(fields, experiment);
  const bool draws = experiment.video.enabled || experiment.detail || experiment.cross_simulator;
  fields.check(
      !draws || experiment.recordings != KeptRecordings::none, "recordings",
      "expected all or pictured: the video, the detail and the cross-simulator overlay are "
      "drawn from them; none goes with video.enabled: false and without the others");
  fields.know("benchmark");
  fields.section("benchmark", experiment.benchmark);
  fields.know("odometry");
  fields.section("odometry", experiment.odometry);
  fields.know("operating_points");
  fields.section("operating_points", experiment.operating_points);
  fields.know("closed_loop");
  if (fields.present("closed_loop", experiment.closed_loop.has_value())) {
    if (fields.reading()) experiment.closed_loop.emplace();
    fields.section("closed_loop", *experiment.closed_loop, experiment);
  }
  fields.know("moments");
  if (fields.present("moments", experiment.moments)) fields("moments", experiment.moments);
}

std::vector<scoring::Hysteresis> points_of(const OperatingPointsConfig& config) {
  std::vector<scoring::Hysteresis> points;
  for (const double leave_below : config.leave_below) {
    for (const double return_above : config.return_above) {
      if (leave_below <= return_above) points.push_back({leave_below, return_above});
    }
  }
  return points;
}

std::size_t points_of(const ClosedLoopScene& scene) {
  return std::max<std::size_t>(1, scene.values.size()) * scene.noise.size() * scene.delay.size();
}

std::vector<std::string> scenario_files(const Experiment& experiment) {
  std::vector<std::string> files = experiment.fit.scenarios;
  files.insert(files.end(), experiment.test.scenarios.begin(), experiment.test.scenarios.end());
  for (const TrainingSegments& segments : experiment.training_segments) {
    files.push_back(segments.scenario);
  }
  if (experiment.closed_loop) {
    for (const ClosedLoopScene& scene : experiment.closed_loop->scenes) {
      files.push_back(scene.scenario);
    }
  }
  return files;
}

std::vector<std::string> robot_files(const Experiment& experiment) {
  std::vector<std::string> files = {""};
  if (experiment.benchmark) {
    const std::vector<std::string>& others = experiment.benchmark->robots;
    files.insert(files.end(), others.begin(), others.end());
  }
  return files;
}

std::vector<std::string> sensor_files(const Experiment& experiment) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& file) {
    if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) {
      files.push_back(file);
    }
  };
  add(experiment.sensors);
  if (experiment.benchmark) {
    for (const std::string& file : experiment.benchmark->sensors) add(file);
  }
  return files;
}

Experiment experiment_from_yaml(const YamlDocument& document,
                                std::vector<EstimatorEntry> external_estimators) {
  check_external_names(external_estimators);
  Experiment defaults;
  defaults.external_estimators = std::move(external_estimators);
  defaults.fit = {.scenarios = {}, .runs = 1, .perturbed = false};
  defaults.test = {.scenarios = {}, .runs = 8, .perturbed = true};
  return from_yaml(document, defaults);
}

void require_files(const YamlDocument& document) {
  require_resources(document,
                    {"fit.scenarios", "fit.segments.scenario", "test.scenarios", "robot", "sensors",
                     "benchmark.robots", "benchmark.sensors", "closed_loop.scenes.scenario"});
}

std::string to_yaml(const Experiment& experiment) { return YAML::Dump(to_node(experiment)) + "\n"; }

}  // namespace touchdown::experiments
