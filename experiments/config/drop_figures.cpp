#include "experiments/config/drop_figures.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/fields.hpp"

namespace touchdown::experiments {

namespace {

/// More would not be readable beside, or above, each other.
constexpr std::size_t most_settings = 3;
constexpr std::size_t most_estimators = 6;

void describe_choice(Fields& fields, DropChoice& choice, const DrawableRuns& runs) {
  fields("run", choice.run, 0, runs.test_runs - 1);
  fields("drop", choice.drop, 0, 1000);
  fields("seed", choice.seed, 0, runs.noise.seeds - 1);
  fields("before", choice.before, 0.0, 10.0);
  fields("after", choice.after, 0.01, 10.0);
}

/// Those that the paper compares and the phase filter; others where the experiment has none of
/// them.
std::vector<std::string> shown_by_default(const std::vector<std::string>& estimators) {
  std::vector<std::string> shown;
  for (const char* name : {"robust", "measurement_only", "reference", "phase"}) {
    if (std::find(estimators.begin(), estimators.end(), name) != estimators.end()) {
      shown.emplace_back(name);
    }
  }
  if (!shown.empty()) return shown;
  shown = estimators;
  if (shown.size() > 4) shown.resize(4);
  return shown;
}

void describe(Fields& fields, DetailConfig& detail, const DrawableRuns& runs) {
  fields.list("noise", detail.noise);
  fields.check(!detail.noise.empty() && detail.noise.size() <= most_settings, "noise",
               fmt::format("expected 1 to {} noise settings", most_settings));
  if (fields.reading()) detail.estimators = shown_by_default(runs.estimators);
  fields.names("estimators", runs.estimators, detail.estimators);
  fields.check(detail.estimators.size() <= most_estimators, "estimators",
               fmt::format("expected at most {} names", most_estimators));
  for (noise::NoiseCell& cell : detail.noise) cell = noise::with_encoder_noise(cell, runs.noise);
}

void describe(Fields& fields, PosteriorConfig& posterior, const DrawableRuns& runs) {
  if (fields.present("noise", true)) fields.section("noise", posterior.noise);
  posterior.noise = noise::with_encoder_noise(posterior.noise, runs.noise);
}

/// A section that is drawn if it is there, and can be switched off where it stands.
template <typename Config>
void describe_switched(Fields& parent, std::string_view key, std::optional<Config>& config,
                       const DrawableRuns& runs) {
  if (!parent.present(key, config.has_value())) return parent.know(key);
  bool enabled = true;
  if (parent.reading()) config.emplace();
  parent.within(key, [&](Fields& fields) {
    if (fields.reading()) fields("enabled", enabled);
    describe_choice(fields, config->choice, runs);
    describe(fields, *config, runs);
  });
  if (!enabled) config.reset();
}

}  // namespace

void describe_drop_figures(Fields& parent, std::optional<DetailConfig>& detail,
                           std::optional<PosteriorConfig>& posterior, const DrawableRuns& runs) {
  describe_switched(parent, "detail", detail, runs);
  describe_switched(parent, "posterior", posterior, runs);
  const bool has_phase =
      std::find(runs.estimators.begin(), runs.estimators.end(), "phase") != runs.estimators.end();
  parent.check(!posterior || has_phase, "posterior",
               "expected 'phase' among the experiment's estimators, or posterior.enabled: false");
}

}  // namespace touchdown::experiments
