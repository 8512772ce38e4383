#include "cli/cross_simulator.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "cli/captions.hpp"
#include "core/error.hpp"
#include "experiments/cross_simulator_tables.hpp"
#include "recordings/recording_file.hpp"
#include "render/drop_overlay.hpp"

namespace touchdown {

namespace {

Recording recording_of(const CrossSimulatorResult& result, const std::string& simulator) {
  const auto run =
      std::find_if(result.runs.begin(), result.runs.end(), [&](const PlayedRun& played) {
        return played.plan.role == RunRole::test && played.plan.simulator == simulator &&
               played.plan.run == result.config.overlay.run;
      });
  return read_recording(result.directory.file("recordings", run->plan.file));
}

Figure draw_overlay(const CrossSimulatorResult& result) {
  const Experiment& experiment = result.config.experiment;
  const OverlayConfig& overlay = result.config.overlay;
  const DropOverlay what{
      .drop = overlay.drop,
      .labels = experiment.labels,
      .minimum_flight = experiment.scoring.minimum_flight,
      .title = fmt::format("One drop in both engines: {}", experiment.test.scenarios.front()),
      .caption = fmt::format("Test run {}, drop {} (of both wheels), seed {}; left wheel and leg, "
                             "aligned at takeoff, without noise; {}.",
                             overlay.run, overlay.drop, experiment.seed, labels_text(experiment))};
  return draw_drop_overlay(recording_of(result, experiment.simulators[0]),
                           recording_of(result, experiment.simulators[1]), what,
                           result.directory.file("figures", "drop_overlay"));
}

}  // namespace

void check_across_simulators(const CrossSimulator& config, const RunOptions& options,
                             bool no_pictures) {
  const CrossSimulatorResult result = run_cross_simulator(config, options);
  fmt::print("{}", report_text(result));
  fmt::print("\nresults   {}\ntables    {}\n", result.directory.path().string(),
             (result.directory.path() / "tables").string());
  std::fflush(stdout);
  if (!no_pictures) fmt::print("figure    {}\n", draw_overlay(result).png.string());
  if (const auto failed = failed_demands(result.verdicts); !failed.empty()) {
    throw Error(fmt::format("demanded verdicts fail: {}", fmt::join(failed, ", ")));
  }
}

}  // namespace touchdown
