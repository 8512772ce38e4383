#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "experiments/config/experiment_yaml.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* test_run_index = "0 to test.runs - 1";

/// Limits of figures: more would not be readable.
constexpr std::size_t most_settings = 3;
constexpr std::size_t most_estimators = 6;

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

/// As many estimators as are readable, the paper's and the filter of loads first.
std::vector<std::string> shown_by_default(std::vector<std::string> estimators) {
  auto next = estimators.begin();
  for (const char* const name : {"robust", "measurement_only", "reference", "load_filter"}) {
    next = std::stable_partition(next, estimators.end(),
                                 [&](const std::string& other) { return other == name; });
  }
  estimators.resize(std::min(estimators.size(), most_estimators));
  return estimators;
}

void describe(Fields& fields, DetailConfig& detail, const Experiment& experiment) {
  fields.list("noise", detail.noise).doc("Noise settings, one column of panels each; at most 3.");
  fields.check(!detail.noise.empty() && detail.noise.size() <= most_settings, "noise",
               fmt::format("expected 1 to {} noise settings", most_settings));
  if (fields.reading()) detail.estimators = shown_by_default(experiment.estimators);
  own_estimators(fields, "estimators", experiment, detail.estimators)
      .fallback("up to 6, robust first")
      .doc("Estimators with probabilities shown, at most 6.");
  fields.check(detail.estimators.size() <= most_estimators, "estimators",
               fmt::format("expected at most {} names", most_estimators));
  for (noise::NoiseCell& cell : detail.noise) {
    cell = noise::as_on_grid(cell, experiment.noise);
  }
}

/// A section that enables a figure if it is present, unless it has `enabled: false`.
template <typename Config>
KeyNotes describe_switched(Fields& parent, std::string_view key, std::optional<Config>& config,
                           const Experiment& experiment) {
  if (!parent.given(key, config.has_value())) return {};
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

}  // namespace

KeyNotes own_estimators(Fields& fields, std::string_view key, const Experiment& experiment,
                        std::vector<std::string>& names) {
  return fields.names(key, experiment.estimators, names)
      .type("list of the experiment's estimators");
}

void describe(Fields& fields, VideoConfig& video, const Experiment& experiment) {
  fields("enabled", video.enabled).doc("Whether a run is plotted and filmed.");
  fields("run", video.run, 0, experiment.test.runs - 1)
      .range(test_run_index)
      .doc("Index of the test run.");
  fields("width", video.width, 320, 7680)
      .doc("px", "Width of a run's film. The report's film has three quarters of it.");
  if (fields.reading()) video.estimators = experiment.estimators;
  own_estimators(fields, "estimators", experiment, video.estimators)
      .fallback("all of them")
      .doc("Estimators with probabilities shown.");
  if (fields.reading() && !fields.documenting()) video.noise = experiment.highlights.front();
  if (fields.given("noise", true)) {
    fields.section("noise", video.noise)
        .fallback("the first highlight")
        .doc("Noise setting of the film.");
  }
  video.noise = noise::as_on_grid(video.noise, experiment.noise);
}

void describe(Fields& fields, PrintConfig& print) {
  fields.optional("width_mm", print.width_mm, narrowest_print, widest_print)
      .doc("mm",
           "Width in print, at which no text is under 6 pt. Without it, figures for screens.");
  fields("caption", print.caption).doc("Whether pictures contain their titles and captions.");
  std::vector<std::string> metrics;
  for (const PointMetric& metric : point_metrics) metrics.emplace_back(metric.name);
  fields.choose("heatmap", metrics, print.heatmap).doc("The metric of maps over noise levels.");
}

void describe_drop_figures(Fields& fields, Experiment& experiment) {
  describe_switched(fields, "detail", experiment.detail, experiment)
      .doc("A figure of signals and estimates during one drop.");
}

}  // namespace touchdown::experiments
