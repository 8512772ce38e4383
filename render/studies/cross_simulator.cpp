#include "experiments/studies/cross_simulator.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/drops.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/gnuplot/facets.hpp"
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

/// Adds the steps of a run around its takeoff, from which time and height count.
void add_steps(const logs::Recording& recording, const DropOverlay& what, Table& table) {
  const std::size_t takeoff = flight_of(recording, what).takeoff;
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(std::llround(seconds / recording.period()));
  };
  const std::size_t begin = takeoff - std::min(takeoff, steps(before));
  const std::size_t end = std::min(recording.steps(), takeoff + steps(after));
  for (std::size_t k = begin; k < end; ++k) {
    const models::Observation& observation = recording.observation[k];
    const models::GroundTruth& truth = recording.truth[k];
    const double time = (static_cast<double>(k) - static_cast<double>(takeoff)) * 1e3;
    table.rows.push_back({recording.info.simulator, time * recording.period(),
                          truth.base_position.z() - recording.truth[takeoff].base_position.z(),
                          truth.wheel_normal_force[0],
                          observation.servo[models::index(models::Servo::left_knee)].torque,
                          observation.servo[models::index(models::Servo::left_wheel)].torque,
                          models::vertical_acceleration(observation.imu)});
  }
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
  experiments::FigureSpec spec;
  spec.x = {.column = "time_ms", .title = "time since takeoff", .unit = "ms"};
  spec.x.from = -1e3 * before;
  spec.x.to = 1e3 * after;
  spec.measures = {{.column = "height_m", .title = "base height", .unit = "m"},
                   {.column = "force_n", .title = "normal force", .unit = "N"},
                   {.column = "knee_torque_nm", .title = "knee torque", .unit = "N·m"},
                   {.column = "wheel_torque_nm", .title = "wheel torque", .unit = "N·m"},
                   {.column = "acceleration_mps2", .title = "vertical acc.", .unit = "m/s²"}};
  Table table{{{"simulator"}, {spec.x.column, ColumnRole::key, ColumnType::exact}}, {}};
  for (const experiments::FigureAxis& measure : spec.measures) {
    table.columns.push_back({measure.column, ColumnRole::metric, ColumnType::exact});
  }
  for (const logs::Recording* recording : {&first, &second}) add_steps(*recording, what, table);
  spec.series = experiments::groups_in(table, "simulator", simulators::simulator_title);
  spec.marks = {{experiments::MarkShape::line}};
  spec.title = what.title;
  spec.caption = what.caption;
  spec.alt = described({&first, &second}, what);
  return draw_facets(spec, table, target).value();
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
