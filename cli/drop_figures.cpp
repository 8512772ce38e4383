#include "cli/drop_figures.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "cli/captions.hpp"
#include "core/error.hpp"
#include "experiments/drop_detail.hpp"
#include "experiments/drop_posterior.hpp"
#include "recordings/recording_file.hpp"
#include "render/drop_detail_figure.hpp"
#include "render/phase_posterior_figure.hpp"
#include "render/report_parts.hpp"

namespace touchdown {

namespace {

/// The chosen run in one engine. Errors: `InputError` when it is not scored.
const PlayedRun& chosen_run(const ExperimentResult& result, const std::string& simulator, int run,
                            const std::string& key) {
  const auto found =
      std::find_if(result.runs.begin(), result.runs.end(), [&](const PlayedRun& played) {
        return played.plan.role == RunRole::test && played.plan.simulator == simulator &&
               played.plan.run == run;
      });
  if (found == result.runs.end() || is_failure(found->report.outcome)) {
    throw InputError(fmt::format("{}.run: run {} in {} is not scored", key, run, simulator));
  }
  return *found;
}

std::string which_drop(const Experiment& experiment, const DropChoice& choice) {
  return fmt::format(
      "Test run {}, drop {} of both wheels (from 0), experiment seed {}, noise seed {}; {}.",
      choice.run, choice.drop, experiment.seed, choice.seed, labels_text(experiment));
}

Figure draw_detail(const ExperimentResult& result, const std::string& simulator) {
  const Experiment& experiment = result.experiment;
  const DetailConfig& config = *experiment.detail;
  const PlayedRun& run = chosen_run(result, simulator, config.choice.run, "detail");
  const Recording recording = read_recording(result.directory.file("recordings", run.plan.file));
  const DropDetail detail = drop_detail(experiment, config, recording, run.heard, result.models);
  const FigureText text{
      fmt::format("One drop in detail: {}, {}", experiment.name, engine_title(simulator)),
      fmt::format("{} Left wheel and leg. Spectra, power and median frequency are those of the "
                  "{:.0f} ms that end at each instant; they and the switch probabilities come from "
                  "the transition model of {}. Dashed verticals: the left wheel leaves or lands.",
                  which_drop(experiment, config.choice), 1e3 / detail.bin_width,
                  detail.transition_of),
      fmt::format(
          "Rows of curves over the time around one drop, {} noise settings beside each "
          "other: height of the base, knee and wheel torque with and without noise, contact "
          "probability of {}, spectrograms of the true and of the noisy vertical "
          "acceleration with their power and median frequency, and the probabilities of a "
          "takeoff and a landing. The time in which the wheel truly touches is tinted.",
          config.noise.size(), fmt::join(config.estimators, ", "))};
  return draw_drop_detail(detail, text, result.directory.file("figures", "detail_" + simulator));
}

FigureText posterior_text(const Experiment& experiment, const PosteriorConfig& config) {
  return {
      fmt::format("The phase filter through one drop: {}", experiment.name),
      fmt::format("{} Noise: {} N·m on torques, {} m/s² on the accelerometer. True phases look "
                  "ahead: an unloading is named after the takeoff that follows. Dashed "
                  "verticals: the last wheel leaves, the first one lands.",
                  which_drop(experiment, config.choice), config.noise.torque,
                  config.noise.accelerometer),
      "Over the time around one drop, for each engine: which wheels truly touch, the true phase, "
      "the probabilities of all phases stacked upon each other, and the contact probability of "
      "both wheels."};
}

/// What an engine's run cannot give is said, not thrown.
template <typename Draw>
void or_say_why_not(const Draw& draw) {
  try {
    draw();
  } catch (const InputError& error) {
    fmt::print(stderr, "touchdown: not drawn: {}\n", error.what());
  }
}

}  // namespace

std::vector<Picture> draw_drop_figures(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::vector<Picture> pictures;
  const auto add = [&](const Figure& figure) { add_figure(pictures, "figure", figure); };
  if (experiment.detail) {
    for (const std::string& simulator : experiment.simulators) {
      or_say_why_not([&] { add(draw_detail(result, simulator)); });
    }
  }
  if (!experiment.posterior) return pictures;
  const PosteriorConfig& config = *experiment.posterior;
  std::vector<DropPosterior> drops;
  for (const std::string& simulator : experiment.simulators) {
    or_say_why_not([&] {
      const PlayedRun& run = chosen_run(result, simulator, config.choice.run, "posterior");
      drops.push_back(drop_posterior(experiment, config, run.heard, result.models));
    });
  }
  if (drops.empty()) return pictures;
  add(draw_phase_posterior(drops, posterior_text(experiment, config),
                           result.directory.file("figures", "phase_posterior")));
  return pictures;
}

}  // namespace touchdown
