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

/// Keys of names from the experiment's own list.
constexpr const char* own_estimators = "list of the experiment's estimators";
constexpr const char* test_run_index = "0 to test.runs - 1";

/// Limits of figures: more would not be readable.
constexpr std::size_t most_settings = 3;
constexpr std::size_t most_estimators = 6;
constexpr std::size_t most_panels = 4;

void describe_choice(Fields& fields, DropChoice& choice, const Experiment& experiment) {
  fields("run", choice.run, 0, experiment.test.runs - 1)
      .range(test_run_index)
      .doc("Index of the test run.");
  fields.choose("wheels", {"both", "left", "right"}, choice.wheels)
      .doc("Which flights count as drops: of both wheels at once, or of one.");
  fields("drop", choice.drop, 0, 1000).doc("Index of the drop in the run.");
  fields.optional("at", choice.at, 0.0, 1e6)
      .doc("s", "Time since the start of the run, instead of a drop.");
  fields("seed", choice.seed, 0, experiment.noise.seeds - 1)
      .range("0 to noise.seeds - 1")
      .doc("Index of the noise draw.");
  fields("before", choice.before, 0.0, 10.0).doc("s", "Shown before takeoff or `at`.");
  fields("after", choice.after, 0.01, 10.0).doc("s", "Shown after takeoff or `at`.");
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
  fields.require("scenarios", runs.scenarios).doc("Scenario files.");
  fields.check(!runs.scenarios.empty(), "scenarios", "expected at least one scenario file");
  fields("runs", runs.runs, 1, 100'000).doc("Runs of each scenario.");
  fields("perturbed", runs.perturbed).doc("Whether perturbations are drawn from the seed.");
}

static void describe(Fields& fields, TrainingSegments& segments) {
  fields.require("scenario", segments.scenario).doc("Scenario file.");
  fields("runs", segments.runs, 1, 100'000).doc("Number of perturbed runs.");
  fields("after", segments.after, 0.0, 1e4).doc("s", "Earliest start of a segment.");
  fields("length", segments.length, 0.01, 1e4)
      .doc("s", "Length of a segment, less if the run ends earlier.");
  fields.renamed("places", "offsets");
  fields("offsets", segments.offsets, 1, 1000)
      .doc("Number of evenly spaced start times; runs use them in turn.");
}

/// All runs of a scenario without perturbations are equal, so they count as one.
static void describe(Fields& fields, TuningConfig& tuning, const RunsConfig& fit) {
  fields.require("trials", tuning.trials, 1, 10'000)
      .doc("Trials of each estimator; the first has its defaults.");
  fields("folds", tuning.folds, 2, 1000).doc("Folds of the fitted runs, for cross-validation.");
  fields("everywhere", tuning.everywhere)
      .doc("Whether a benchmark's other robots and sensors have trials of their own.");
  if (fields.present("noise", true)) {
    fields.list("noise", tuning.noise).doc("Noise settings of the trials.");
  }
  fields.check(!tuning.noise.empty(), "noise", "expected at least one noise setting");
  const std::size_t runs =
      fit.scenarios.size() * (fit.perturbed ? static_cast<std::size_t>(fit.runs) : 1);
  fields.finish();
  fields.check(static_cast<std::size_t>(tuning.folds) <= runs, "folds",
               fmt::format("expected at most the number of different fitted runs, {}", runs));
}

static void describe(Fields& fields, VideoConfig& video, const Experiment& experiment) {
  fields("enabled", video.enabled).doc("Whether a run is plotted and filmed.");
  fields("run", video.run, 0, experiment.test.runs - 1)
      .range(test_run_index)
      .doc("Index of the test run.");
  if (fields.reading()) video.estimators = {experiment.estimators.front()};
  fields.names("estimators", experiment.estimators, video.estimators)
      .type(own_estimators)
      .fallback("the first one")
      .doc("Estimators with probabilities shown.");
  fields("torque_noise", video.torque_noise, 0.0, 1e3)
      .doc("N·m", "Noise on knee and wheel torques.");
  fields("accelerometer_noise", video.accelerometer_noise, 0.0, 1e3)
      .doc("m/s²", "Noise on each acceleration.");
}

static void describe(Fields& fields, DetailConfig& detail, const Experiment& experiment) {
  fields.list("noise", detail.noise).doc("Noise settings, one column of panels each; at most 3.");
  fields.check(!detail.noise.empty() && detail.noise.size() <= most_settings, "noise",
               fmt::format("expected 1 to {} noise settings", most_settings));
  if (fields.reading()) detail.estimators = shown_by_default(experiment.estimators);
  fields.names("estimators", experiment.estimators, detail.estimators)
      .type(own_estimators)
      .fallback("up to 6, robust first")
      .doc("Estimators with probabilities shown, at most 6.");
  fields.check(detail.estimators.size() <= most_estimators, "estimators",
               fmt::format("expected at most {} names", most_estimators));
  for (noise::NoiseCell& cell : detail.noise) {
    cell = noise::as_on_grid(cell, experiment.noise);
  }
}

static void describe(Fields& fields, PosteriorConfig& posterior, const Experiment& experiment) {
  if (fields.present("noise", true)) {
    fields.section("noise", posterior.noise).doc("Noise setting of the figure.");
  }
  posterior.noise = noise::as_on_grid(posterior.noise, experiment.noise);
}

/// A section that enables a figure if it is present, unless it has `enabled: false`.
template <typename Config>
static KeyNotes describe_switched(Fields& parent, std::string_view key,
                                  std::optional<Config>& config, const Experiment& experiment) {
  if (!parent.present(key, config.has_value())) {
    parent.know(key);
    return {};
  }
  bool enabled = true;
  if (parent.reading()) config.emplace();
  const KeyNotes notes = parent.within(key, [&](Fields& fields) {
    if (fields.reading()) fields("enabled", enabled).doc("Whether the figure is drawn.");
    describe_choice(fields, config->choice, experiment);
    describe(fields, *config, experiment);
  });
  if (!enabled) config.reset();
  return notes.fallback("none");
}

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

/// A mapping of keys to lists of values.
static void describe(Fields& fields, std::vector<SensorFactor>& factors) {
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
                    .type(own_estimators)
                    .doc("Estimators that must pass, or the run fails.");
              })
      .doc("What an estimator must achieve.");
  section
      .within("overlay",
              [&](Fields& fields) {
                fields("run", config.overlay.run, 0, experiment.test.runs - 1)
                    .range(test_run_index)
                    .doc("Index of the test run.");
                fields("drop", config.overlay.drop, 0, 1000).doc("Index of the drop in the run.");
              })
      .doc("The drop that is plotted in both engines.");
}

static void describe(Fields& fields, BenchmarkConfig& benchmark) {
  const auto describe_files = [&](const char* key, std::vector<std::string>& files) {
    const KeyNotes notes = fields(key, files);
    for (auto file = files.begin(); file != files.end(); ++file) {
      fields.check(std::find(files.begin(), file, *file) == file, key,
                   fmt::format("'{}' appears twice", *file));
    }
    return notes;
  };
  describe_files("robots", benchmark.robots).doc("Files of further robots.");
  describe_files("sensors", benchmark.sensors).doc("Files of further sensor profiles.");
  fields("transfer", benchmark.transfer)
      .doc("Whether fits on another robot, other sensors or the other engine are scored, too.");
  fields("refits", benchmark.refits, 0, 1000)
      .doc("Fits repeated on resampled runs, for wider intervals.");
  fields("refits_everywhere", benchmark.refits_everywhere)
      .doc("Whether refits cover all robots and sensors, or the experiment's own.");
  fields("clips", benchmark.clips).doc("Whether the worst segment of every estimator is filmed.");
}

static void describe(Fields& fields, OdometryStudyConfig& odometry) {
  fields.renamed("late", "delay");
  fields.in_line("delay", odometry.delay)
      .range("above 0, to 1")
      .doc("s", "Delays of true contact; odometry runs with each.");
  for (auto delay = odometry.delay.begin(); delay != odometry.delay.end(); ++delay) {
    fields.check(*delay > 0.0 && *delay <= 1.0, "delay", "expected times between 0 and 1 s");
    fields.check(std::find(odometry.delay.begin(), delay, *delay) == delay, "delay",
                 fmt::format("{} appears twice", *delay));
  }
}

static void describe(Fields& fields, OperatingPointsConfig& config) {
  const auto describe_thresholds = [&](const char* key, std::vector<double>& thresholds) {
    const KeyNotes notes = fields.in_line(key, thresholds);
    fields.check(!thresholds.empty(), key, "expected at least one probability");
    fields.check(thresholds.empty() ||
                     (thresholds.front() > 0.0 && thresholds.back() < 1.0 &&
                      std::is_sorted(thresholds.begin(), thresholds.end(), std::less_equal<>())),
                 key, "expected increasing probabilities, none of them 0 or 1");
    return notes.range("between 0 and 1, increasing");
  };
  describe_thresholds("leave_below", config.leave_below)
      .doc("Thresholds of P(contact) below which contact ends.");
  describe_thresholds("return_above", config.return_above)
      .doc("Thresholds of P(contact) above which contact begins.");
  fields.check(config.leave_below.front() <= config.return_above.back(), "return_above",
               "expected a threshold of at least the lowest leave_below");
}

static void describe(Fields& fields, ClosedLoopScene& scene, const Experiment& experiment) {
  fields.require("scenario", scene.scenario).doc("Scenario file.");
  fields.know("key");
  fields.know("values");
  if (fields.present("key", !scene.key.empty()) || fields.present("values", false)) {
    fields.require("key", scene.key)
        .fallback("none")
        .doc("Dotted key of the scenario that is varied.");
    fields.require("values", scene.values).fallback("none").doc("Increasing values of the key.");
    fields.check(!scene.values.empty(), "values", "expected at least one number");
    fields.check(std::is_sorted(scene.values.begin(), scene.values.end(), std::less_equal<>()),
                 "values", "expected increasing numbers");
  }
  if (fields.present("noise", true)) {
    fields.list("noise", scene.noise).doc("Noise settings, besides the sensor profile.");
  }
  fields.check(!scene.noise.empty(), "noise", "expected at least one noise setting");
  for (noise::NoiseCell& cell : scene.noise) cell = noise::as_on_grid(cell, experiment.noise);
  fields.renamed("late", "delay");
  fields.in_line("delay", scene.delay)
      .range("0 to 1, increasing")
      .doc("s", "Delays of the contact signal.");
  fields.check(!scene.delay.empty() && scene.delay.front() >= 0.0 && scene.delay.back() <= 1.0 &&
                   std::is_sorted(scene.delay.begin(), scene.delay.end(), std::less_equal<>()),
               "delay", "expected increasing times from 0 to 1 s");
  const int varied = (scene.values.size() > 1 ? 1 : 0) + (scene.noise.size() > 1 ? 1 : 0) +
                     (scene.delay.size() > 1 ? 1 : 0);
  fields.check(varied <= 1, "scenario",
               "expected at most one varied quantity: values of a key, noise, or delay");
}

static void describe(Fields& fields, ClosedLoopFilm& film, const ClosedLoopConfig& config) {
  fields("scene", film.scene, 0, static_cast<int>(config.scenes.size()) - 1)
      .range("an index in closed_loop.scenes")
      .doc("Index of the scene.");
  const std::size_t points = points_of(config.scenes[static_cast<std::size_t>(film.scene)]);
  fields("point", film.point, 0, static_cast<int>(points) - 1)
      .range("an index in its values")
      .doc("Index of the varied value.");
  fields("run", film.run, 0, config.runs - 1).range("0 to runs - 1").doc("Index of the run.");
  if (fields.reading()) film.law = config.laws.front();
  fields.choose("law", config.laws, film.law)
      .type("one of closed_loop.laws")
      .fallback("the first one")
      .doc("Control law.");
  if (fields.reading()) {
    film.contact = config.contact;
    film.contact.resize(std::min(most_panels, film.contact.size()));
  }
  fields.names("contact", config.contact, film.contact)
      .type("list of closed_loop.contact")
      .fallback("the first 4")
      .doc("Contact sources side by side, at most 4.");
  fields.check(film.contact.size() <= most_panels, "contact",
               fmt::format("expected at most {} names", most_panels));
}

static void describe(Fields& fields, ClosedLoopConfig& config, const Experiment& experiment) {
  fields.names("laws", {"balancer", "soft_landing"}, config.laws).doc("Control laws.");
  std::vector<std::string> contact_sources = {"truth", "always"};
  contact_sources.insert(contact_sources.end(), experiment.estimators.begin(),
                         experiment.estimators.end());
  if (fields.reading()) config.contact = contact_sources;
  fields.names("contact", contact_sources, config.contact)
      .type("list of truth, always, the experiment's estimators")
      .fallback("all")
      .doc("Contact sources of the policy.");
  fields.require("scenes");
  fields.list("scenes", config.scenes, experiment)
      .doc("Scenes, each with at most one varied quantity.");
  fields.check(!config.scenes.empty(), "scenes", "expected at least one scene");
  fields("runs", config.runs, 1, 100'000)
      .doc("Runs per scene and value, the same for all contact sources.");
  fields.know("film");
  if (!fields.present("film", config.film.has_value())) return;
  if (fields.reading()) config.film.emplace();
  fields.within("film", [&](Fields& film) { describe(film, *config.film, config); })
      .fallback("none")
      .doc("The run that is filmed.");
}

static void describe_fit(Fields& fit, Experiment& experiment) {
  describe(fit, experiment.fit);
  fit.renamed("pieces", "segments");
  fit.list_if_any("segments", experiment.training_segments)
      .doc("Segments of runs: phase models are fitted to these instead, others to both.");
  fit.know("tuning");
  if (fit.present("tuning", experiment.tuning.has_value())) {
    if (fit.reading()) experiment.tuning.emplace();
    fit.section("tuning", *experiment.tuning, experiment.fit)
        .fallback("none")
        .doc("The same number of trials for every estimator with hyperparameters.");
  }
  if (!fit.present("seed", experiment.fit_seed.has_value())) return;
  fit.optional("seed", experiment.fit_seed)
      .fallback("the experiment's")
      .doc("Seed of the fitted runs.");
}

/// By estimator, then name, as tuning chooses them.
static void describe_hyperparameters(Fields& fields, Experiment& experiment) {
  constexpr const char* key = "hyperparameters";
  fields.renamed("constants", key);
  fields.know(key);
  if (!fields.present(key, !experiment.hyperparameters.empty())) return;
  const auto describe_all = [&](Fields& all) {
    for (const std::string& name : all.documenting() ? estimator_names() : experiment.estimators) {
      all.know(name);
      if (!all.present(name, experiment.hyperparameters.contains(name))) continue;
      if (all.documenting() && estimator_entry(name).hyperparameters.empty()) continue;
      HyperparameterValues& hyperparameters = experiment.hyperparameters[name];
      const auto describe_own = [&](Fields& own) {
        for (const Hyperparameter& one :
             estimator_entry(name, experiment.external_estimators).hyperparameters) {
          own.know(one.name);
          if (!own.present(one.name, hyperparameters.contains(one.name))) continue;
          own(one.name, hyperparameters[one.name])
              .fallback(value_text(YAML::Node(one.value)))
              .doc(fmt::format("Tuning draws it from {:g} to {:g}.", one.lowest, one.highest));
        }
      };
      all.within(name, describe_own).doc("Hyperparameters of this estimator.");
    }
  };
  fields.within(key, describe_all)
      .fallback("none")
      .doc("Values instead of the estimators' defaults; not beside `fit.tuning`.");
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
  fields.section(key, *config, experiment)
      .fallback("none")
      .doc("How much the results depend on the engine.");
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
  fields.require("name", experiment.name).doc("Name of the run directory and in captions.");
  fields.check(is_name_word(experiment.name), "name", expected_name_word);
  fields("seed", experiment.seed).doc("Seed of all random draws.");
  fields.names("simulators", simulators::simulator_names(), experiment.simulators)
      .doc("Physics engines.");
  require_python(fields, experiment);
  fields.names("estimators", estimator_names(experiment.external_estimators), experiment.estimators)
      .doc("Estimators, in the order of tables.");
  fields.require("fit");
  fields.require("test");
  fields.within("fit", [&](Fields& fit) { describe_fit(fit, experiment); })
      .doc("Noiseless runs to which models are fitted.");
  describe_hyperparameters(fields, experiment);
  fields.section("test", experiment.test).doc("Runs for scoring; no model is fitted to them.");
  const auto file_if_any = [&](const char* key, std::string& file) {
    fields.know(key);
    if (!fields.present(key, !file.empty())) return KeyNotes();
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
  fields.know("sweep");
  if (fields.present("sweep", !experiment.sweep.empty())) {
    fields.section("sweep", experiment.sweep)
        .fallback("none")
        .doc("Disturbances of the sensors that are varied, one at a time.");
  }
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
  describe_switched(fields, "detail", experiment.detail, experiment)
      .doc("A figure of signals and estimates during one drop.");
  describe_switched(fields, "posterior", experiment.posterior, experiment)
      .doc("A figure of the phase filter's probabilities during one drop.");
  const auto& names = experiment.estimators;
  fields.check(
      !experiment.posterior || std::find(names.begin(), names.end(), "phase") != names.end(),
      "posterior",
      "expected 'phase' among the experiment's estimators, or posterior.enabled: false");
  fields.choose("recordings", {"all", "pictured", "none"}, experiment.recordings)
      .doc("Recordings that the run directory keeps.");
  fields("paper_tables", experiment.paper_tables)
      .doc("Whether the paper's Tables I to III are printed for every highlight.");
  if (fields.reading()) {
    fields("workers", experiment.workers, 0, 4096)
        .doc("Threads; 0: one per core. They change no result.");
  }
  describe_cross_simulator(fields, experiment);
  const bool draws = experiment.video.enabled || experiment.detail || experiment.cross_simulator;
  fields.check(
      !draws || experiment.recordings != KeptRecordings::none, "recordings",
      "expected all or pictured: the video, the detail and the cross-simulator overlay are "
      "drawn from them; none goes with video.enabled: false and without the others");
  fields.know("benchmark");
  fields.section("benchmark", experiment.benchmark)
      .doc("Further robots and sensors; every scene is scored separately.");
  fields.know("odometry");
  fields.section("odometry", experiment.odometry)
      .doc("Odometry on every test run, by contact source.");
  fields.know("operating_points");
  fields.section("operating_points", experiment.operating_points)
      .doc("Scores of every estimator with other thresholds.");
  fields.know("closed_loop");
  if (fields.present("closed_loop", experiment.closed_loop.has_value())) {
    if (fields.reading()) experiment.closed_loop.emplace();
    fields.section("closed_loop", *experiment.closed_loop, experiment)
        .fallback("none")
        .doc("Runs with contact feedback from estimators, the truth or no source.");
  }
  fields.know("moments");
  if (fields.present("moments", experiment.moments)) {
    fields("moments", experiment.moments)
        .doc("Whether torques are compared with the real robot's.");
  }
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

static Experiment default_experiment(std::vector<EstimatorEntry> external_estimators) {
  Experiment defaults;
  defaults.external_estimators = std::move(external_estimators);
  defaults.fit = {.scenarios = {}, .runs = 1, .perturbed = false};
  defaults.test = {.scenarios = {}, .runs = 8, .perturbed = true};
  return defaults;
}

Experiment experiment_from_yaml(const YamlDocument& document,
                                std::vector<EstimatorEntry> external_estimators) {
  check_external_names(external_estimators);
  return from_yaml(document, default_experiment(std::move(external_estimators)));
}

std::vector<Key> experiment_keys() { return documented_keys(default_experiment({})); }

void require_files(const YamlDocument& document) {
  require_resources(document,
                    {"fit.scenarios", "fit.segments.scenario", "test.scenarios", "robot", "sensors",
                     "benchmark.robots", "benchmark.sensors", "closed_loop.scenes.scenario"});
}

std::string to_yaml(const Experiment& experiment) { return YAML::Dump(to_node(experiment)) + "\n"; }

}  // namespace touchdown::experiments
