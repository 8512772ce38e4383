#include "experiments/studies/cross_simulator.hpp"

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/drop_overlay.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::render {

/// One drop of one test run in both engines.
static Figure draw_overlay(const experiments::ExperimentResult& result) {
  const experiments::Experiment& experiment = result.experiment;
  const experiments::OverlayConfig& overlay =
      experiment.studies.at<experiments::CrossSimulatorConfig>().overlay;
  const DropOverlay what{
      .drop = overlay.drop,
      .labels = experiment.labels,
      .minimum_flight = experiment.scoring.minimum_flight,
      .title = fmt::format("One drop in both engines: {}", experiment.test.scenarios.front()),
      .caption = fmt::format("Test run {}, drop {} (of both wheels), seed {}; left wheel and leg, "
                             "aligned at takeoff, without noise; {}.",
                             overlay.run, overlay.drop, experiment.seed,
                             experiments::labels_text(experiment))};
  const auto recording = [&](const std::string& simulator) {
    return chosen_recording(result, simulator, overlay.run, "overlay");
  };
  return draw_drop_overlay(recording(experiment.simulators[0]), recording(experiment.simulators[1]),
                           what, result.directory.file("figures", "drop_overlay"));
}

StudyPictures cross_simulator_pictures() {
  return {.is_requested =
              [](const experiments::Experiment& experiment) {
                return experiment.studies.has<experiments::CrossSimulatorConfig>();
              },
          .draw =
              [](const experiments::ExperimentResult& result) {
                draw_if_possible([&] { draw_overlay(result); });
              }};
}

}  // namespace touchdown::render
