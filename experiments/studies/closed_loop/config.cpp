#include "experiments/studies/closed_loop/config.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

/// Sources side by side in a film: more would not be readable.
static constexpr std::size_t most_panels = 4;

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

std::size_t points_of(const ClosedLoopScene& scene) {
  return std::max<std::size_t>(1, scene.values.size()) * scene.noise.size() * scene.delay.size();
}

StudySection closed_loop_section() {
  StudySection section = optional_section<ClosedLoopConfig>(
      "closed_loop", "Runs with contact feedback from estimators, the truth or no source.");
  section.files = [](const Experiment& experiment) {
    StudyFiles files;
    const auto* const config = experiment.studies.find<ClosedLoopConfig>();
    if (config == nullptr) return files;
    for (const ClosedLoopScene& scene : config->scenes) files.scenarios.push_back(scene.scenario);
    return files;
  };
  section.file_keys = {"closed_loop.scenes.scenario"};
  return section;
}

}  // namespace touchdown::experiments
