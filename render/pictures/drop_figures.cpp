#include "render/pictures/drop_figures.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "experiments/results/drops.hpp"
#include "render/curves/drop_detail_figure.hpp"
#include "render/curves/phase_posterior_figure.hpp"
#include "render/pictures/chosen_run.hpp"
#include "render/pictures/stop.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

std::string which_drop(const experiments::Experiment& experiment,
                       const experiments::DropChoice& choice) {
  const std::string when = choice.at ? fmt::format("around {:.6g} s", *choice.at)
                                     : fmt::format("drop {} of {} (from 0)", choice.drop,
                                                   experiments::to_text(choice.wheels));
  return fmt::format("Test run {}, {}, experiment seed {}, noise seed {}; {}{}.", choice.run, when,
                     experiment.seed, choice.seed, experiments::labels_text(experiment),
                     experiments::setup_caption(experiment));
}

/// "Not shown: NMN, Free fall."; empty where all of the experiment's estimators are shown.
std::string left_out_text(const experiments::Experiment& experiment,
                          const std::vector<std::string>& shown) {
  std::vector<std::string> titles;
  for (const std::string& name : experiment.estimators) {
    if (std::find(shown.begin(), shown.end(), name) != shown.end()) continue;
    titles.push_back(experiments::estimator_title(name));
  }
  return titles.empty() ? "" : fmt::format(" Not shown: {}.", fmt::join(titles, ", "));
}

Figure draw_detail(const experiments::ExperimentResult& result, const std::string& simulator) {
  const experiments::Experiment& experiment = result.experiment;
  const experiments::DetailConfig& config = *experiment.detail;
  const experiments::Rollout& run = chosen_run(result, simulator, config.choice.run, "detail");
  const recordings::Recording recording =
      chosen_recording(result, simulator, config.choice.run, "detail");
  const experiments::DropDetail detail =
      experiments::drop_detail(experiment, config, recording, run.signals, result.models);
  const FigureText text{
      fmt::format("One {} in detail: {}, {}", config.choice.at ? "moment" : "drop", experiment.name,
                  simulators::simulator_title(simulator)),
      fmt::format(
          "{} Left wheel and leg. Spectra, power and median frequency are computed over the "
          "{:.0f} ms before each instant. They, the switch probabilities and the torque "
          "evidence come from the models of {}. Dashed verticals: takeoffs and landings of "
          "the left wheel.{}",
          which_drop(experiment, config.choice), 1e3 / detail.bin_width, detail.transition_of,
          left_out_text(experiment, config.estimators)),
      fmt::format(
          "Rows of curves over the time around one drop, with a column for each of {} noise "
          "settings: height of the base, knee and wheel torque with and without noise, evidence of "
          "these torques for contact, contact probability of {}, spectrograms of the true and of "
          "the noisy vertical acceleration with their power and median frequency, and the "
          "probabilities of a takeoff and a landing. The time in true contact is tinted.",
          config.noise.size(), fmt::join(config.estimators, ", "))};
  return draw_drop_detail(detail, experiment.estimators, text,
                          result.directory.file("figures", "detail_" + simulator));
}

FigureText posterior_text(const experiments::Experiment& experiment,
                          const experiments::PosteriorConfig& config) {
  return {
      fmt::format("The phase filter through one {}: {}", config.choice.at ? "moment" : "drop",
                  experiment.name),
      fmt::format(
          "{} Noise: {} N·m on torques, {} m/s² on the accelerometer. True phases look "
          "ahead: an unloading is named after the takeoff that follows. Likelihoods are "
          "those of one step, tempered as in the filter; black: the true phase. "
          "Log-likelihood error: where the most probable phase is wrong about a wheel, its "
          "log-likelihood ratio to the true phase, by source; memory is the previous belief. "
          "Dashed verticals: the last wheel leaves the ground, the first one lands.",
          which_drop(experiment, config.choice), config.noise.torque, config.noise.accelerometer),
      "Over the time around one drop, for each engine: true contact of both wheels, the true "
      "phase, the likelihood of every phase, the log-likelihood error by source, the stacked "
      "probabilities "
      "of all phases, and the contact probability of both wheels."};
}

}  // namespace

std::vector<Figure> draw_drop_figures(const experiments::ExperimentResult& result,
                                      const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  std::vector<Figure> figures;
  if (experiment.detail) {
    for (const std::string& simulator : experiment.simulators) {
      stop_if_asked(stop);
      draw_if_possible([&] { figures.push_back(draw_detail(result, simulator)); });
    }
  }
  if (!experiment.posterior) return figures;
  const experiments::PosteriorConfig& config = *experiment.posterior;
  std::vector<experiments::DropPosterior> drops;
  for (const std::string& simulator : experiment.simulators) {
    stop_if_asked(stop);
    draw_if_possible([&] {
      const experiments::Rollout& run =
          chosen_run(result, simulator, config.choice.run, "posterior");
      drops.push_back(experiments::drop_posterior(experiment, config, run.signals, result.models));
    });
  }
  if (drops.empty()) return figures;
  figures.push_back(draw_phase_posterior(drops, posterior_text(experiment, config),
                                         result.directory.file("figures", "phase_posterior")));
  return figures;
}

}  // namespace touchdown::render
