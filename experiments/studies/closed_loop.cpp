#include "experiments/studies/closed_loop.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/studies/registry.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::experiments {

namespace {

/// The name of the section, and of its model tasks.
constexpr const char* closed_loop_name = "closed_loop";

/// Sources side by side in a film: more would not be readable.
constexpr std::size_t most_panels = 4;

/// The points of a scene. At most one of values, noise and delay has more than one entry.
std::vector<ClosedLoopCell> points(const ClosedLoopScene& scene, ClosedLoopCell cell) {
  std::vector<double> values = scene.values;
  if (values.empty()) values = {std::numeric_limits<double>::quiet_NaN()};
  std::vector<ClosedLoopCell> cells;
  for (const double value : values) {
    for (const noise::NoiseCell& noise : scene.noise) {
      for (const double delay : scene.delay) {
        cell.point = cells.size();
        cell.value = value;
        cell.noise = noise;
        cell.delay = delay;
        cells.push_back(cell);
      }
    }
  }
  return cells;
}

}  // namespace

static void describe(Fields& fields, ClosedLoopScene& scene, const Experiment& experiment) {
  fields.require("scenario", scene.scenario).doc("Scenario file.");
  const bool has_key = fields.given("key", !scene.key.empty());
  if (fields.given("values", false) || has_key) {
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
  const std::size_t count = points(config.scenes[static_cast<std::size_t>(film.scene)], {}).size();
  fields("point", film.point, 0, static_cast<int>(count) - 1)
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
  fields.section("film", config.film, config).doc("The run that is filmed.");
}

std::vector<ClosedLoopCell> closed_loop_cells(const Experiment& experiment) {
  const auto& config = experiment.studies.at<ClosedLoopConfig>();
  std::vector<ClosedLoopCell> cells;
  for (std::size_t scene = 0; scene < config.scenes.size(); ++scene) {
    for (const std::string& simulator : experiment.simulators) {
      for (const std::string& law : config.laws) {
        for (const std::string& contact : config.contact) {
          const std::vector<ClosedLoopCell> of_curve =
              points(config.scenes[scene],
                     {.simulator = simulator, .law = law, .contact = contact, .scene = scene});
          cells.insert(cells.end(), of_curve.begin(), of_curve.end());
        }
      }
    }
  }
  return cells;
}

scenarios::Scenario scenario_of(const RunRequest& request, const ClosedLoopCell& cell) {
  const ClosedLoopScene& scene =
      request.experiment.studies.at<ClosedLoopConfig>().scenes[cell.scene];
  const NamedScenario& named = scenario_of(request, scene.scenario);
  scenarios::Scenario scenario = named.scenario;
  try {
    if (!scene.key.empty()) {
      scenario = scenarios::varied(scenario, scene.key, cell.value, named.file);
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("closed_loop.scenes.{}: {}={}: {}", cell.scene, scene.key,
                                 exact(cell.value), error.what()));
  }
  using Law = policies::PolicyConfig::Law;
  scenario.policy = {.law = cell.law == "balancer" ? Law::balancer : Law::soft_landing,
                     .contact = cell.contact,
                     .delay = cell.delay};
  return scenario;
}

namespace {

/// Checks all cells. Errors: as above; `InputError` for scenes with another control period than the
/// test runs, and for contact sources that need whole runs.
void require_closed_loop(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  const auto& config = experiment.studies.at<ClosedLoopConfig>();
  const std::int64_t period =
      scenario_of(request, experiment.test.scenarios.front()).scenario.simulation.steps.control_us;
  for (const ClosedLoopCell& cell : closed_loop_cells(experiment)) {
    const ClosedLoopScene& scene = config.scenes[cell.scene];
    if (scenario_of(request, cell).simulation.steps.control_us != period) {
      throw InputError(fmt::format(
          "closed_loop.scenes.{}: {} has another control period than the test runs, for which "
          "estimators are fitted",
          cell.scene, scene.scenario));
    }
    const bool is_estimator = !cell.is_oracle() && cell.contact != "always";
    if (is_estimator && estimator_entry(experiment, cell.contact).making.by_step == nullptr) {
      throw InputError(fmt::format(
          "closed_loop.contact: '{}' needs whole runs, but a policy gets contact step by step",
          cell.contact));
    }
  }
}

/// Its model tasks are runs, numbered from 0; those of a cell are consecutive.
class ClosedLoopStudy final : public SectionStudy<ClosedLoopConfig> {
 public:
  std::optional<StudySection> section() const override {
    StudySection section = optional_section<ClosedLoopConfig>(
        closed_loop_name, "Runs with contact feedback from estimators, the truth or no source.");
    section.files = [](const Experiment& experiment) {
      ExperimentFiles files;
      const auto* const config = experiment.studies.find<ClosedLoopConfig>();
      if (config == nullptr) return files;
      for (const ClosedLoopScene& scene : config->scenes) files.scenarios.push_back(scene.scenario);
      return files;
    };
    section.file_keys = {"closed_loop.scenes.scenario"};
    return section;
  }

  void plan(const RunRequest& request, Plan& plan) const override {
    require_closed_loop(request);
    const std::size_t items = closed_loop_cells(request.experiment).size() *
                              static_cast<std::size_t>(section_of(request.experiment).runs);
    const auto scenes = std::make_shared<scenarios::CompiledScenes>();
    plan.model_tasks.push_back(
        {closed_loop_name, "run", items,
         [request, scenes](std::size_t run, const FittedModels& models,
                           const ShouldContinue& should_continue) {
           return pack(measure_closed_loop(request, run, models, *scenes, should_continue));
         }});
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    return summarize_closed_loop(evaluation, directory);
  }
};

}  // namespace

std::unique_ptr<const Study> closed_loop_study() {
  return std::make_unique<const ClosedLoopStudy>();
}

}  // namespace touchdown::experiments
