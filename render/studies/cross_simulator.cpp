#include "experiments/studies/cross_simulator.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/drops.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/studies/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr double before = 0.15, after = 0.45;  ///< shown before and after the takeoff (s)

scoring::Flight flight_of(const logs::Recording& recording, const DropOverlay& what) {
  const std::vector<scoring::Flight> found = experiments::drops(
      scoring::contact_labels(recording, what.labels), recording.period(), what.minimum_flight);
  const auto number = static_cast<std::size_t>(what.drop);
  if (number < found.size()) return found[number];
  throw InputError(
      fmt::format("overlay.drop: the run in {} has {} drops, counted from 0; none is number {}",
                  recording.info.simulator, found.size(), what.drop));
}

/// The data: time since takeoff (ms), then the drawn quantities. Heights count from takeoff's.
std::string columns(const logs::Recording& recording, const DropOverlay& what) {
  const std::size_t takeoff = flight_of(recording, what).takeoff;
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(std::llround(seconds / recording.period()));
  };
  std::string text =
      "# time_ms\theight_m\tforce_n\tknee_torque_nm\twheel_torque_nm\tacceleration_mps2\n";
  const std::size_t begin = takeoff - std::min(takeoff, steps(before));
  const std::size_t end = std::min(recording.steps(), takeoff + steps(after));
  for (std::size_t k = begin; k < end; ++k) {
    const models::Observation& observation = recording.observation[k];
    const models::GroundTruth& truth = recording.truth[k];
    const double time = (static_cast<double>(k) - static_cast<double>(takeoff)) * 1e3;
    const std::array<double, 6> row = {
        time * recording.period(),
        truth.base_position.z() - recording.truth[takeoff].base_position.z(),
        truth.wheel_normal_force[0],
        observation.servo[models::index(models::Servo::left_knee)].torque,
        observation.servo[models::index(models::Servo::left_wheel)].torque,
        models::vertical_acceleration(observation.imu)};
    for (const double value : row) text.append(number(value)).append(1, '\t');
    text.back() = '\n';
  }
  return text;
}

std::string described(const std::array<const logs::Recording*, 2>& recordings,
                      const DropOverlay& what) {
  std::string text = "Height, normal force, torques and acceleration through one drop.";
  for (const logs::Recording* recording : recordings) {
    const scoring::Flight flight = flight_of(*recording, what);
    const auto steps = static_cast<double>(flight.landing - flight.takeoff);
    text += fmt::format(" {}: {:.0f} ms in the air.",
                        simulators::simulator_title(recording->info.simulator),
                        1e3 * steps * recording->period());
  }
  return text;
}

}  // namespace

Figure draw_drop_overlay(const logs::Recording& first, const logs::Recording& second,
                         const DropOverlay& what, const FigureFile& target) {
  constexpr std::array<const char*, 5> labels = {"base height\n(m)", "normal force\n(N)",
                                                 "knee torque\n(N·m)", "wheel torque\n(N·m)",
                                                 "vertical acc.\n(m/s²)"};
  constexpr std::array<double, labels.size()> tics = {0.1, 500.0, 5.0, 1.0, 100.0};
  const std::string name = target.name();
  const std::array<const logs::Recording*, 2> recordings = {&first, &second};
  std::vector<PlotData> data;
  for (const logs::Recording* recording : recordings) {
    data.push_back(
        {fmt::format("{}_{}.dat", name, recording->info.simulator), columns(*recording, what)});
  }
  PanelGrid::Layout layout;
  layout.row_heights.assign(labels.size(), 124.0);
  layout.panel_width = 860.0;
  layout.right = 130.0;
  layout.keys = {2};
  const PanelGrid grid(target, layout, {what.title, what.caption, described(recordings, what)});
  std::string commands =
      grid.begin(-1e3 * before, 1e3 * after) +
      "set arrow 1 from 0,graph 0 to 0,graph 1 nohead back lc rgb '#6b747d' lw 1.2 dt 1\n";
  for (std::size_t panel = 0; panel < labels.size(); ++panel) {
    commands += grid.panel(panel, 0, labels[panel]) + (panel == 0 ? grid.key(0) : "") +
                fmt::format("set ytics {}\nplot ", tics[panel]);
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      commands +=
          fmt::format("{}{} using 1:{} with lines lt {} title {}", i == 0 ? "" : ", ",
                      gnuplot_file(data[i].name), panel + 2, i + 1,
                      gnuplot_text(simulators::simulator_title(recordings[i]->info.simulator)));
    }
    commands += '\n';
  }
  return grid.draw(commands, data);
}

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
                           what, figure_file(result, "drop_overlay"));
}

StudyPictures cross_simulator_pictures() {
  return {.is_requested = has_section<experiments::CrossSimulatorConfig>,
          .draw = [](const experiments::ExperimentResult& result) {
            draw_if_possible([&] { draw_overlay(result); });
          }};
}

}  // namespace touchdown::render
