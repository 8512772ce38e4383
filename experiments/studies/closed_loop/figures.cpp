#include "experiments/studies/closed_loop/figures.hpp"

#include <string>

#include <fmt/format.h>

#include "experiments/figures/groups.hpp"
#include "experiments/results/odometry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The varied quantity as an axis.
FigureAxis axis_of(const std::string& varied) {
  if (varied == "delay") return {"delay_ms", "delay of contact feedback", "ms"};
  if (varied == "noise") return {"torque_noise_nm", "torque noise", "N·m"};
  if (varied == "rise") return {"value", "height of a step", "m"};
  if (varied == "velocity") return {"value", "commanded speed", "m/s"};
  return {"value", varied};
}

/// One scene under one law, with at most one varied quantity.
struct SurvivalFigure {
  std::string scene, law, varied;
  std::string sensors, runs;
};

std::string caption_of(const SurvivalFigure& figure, double level) {
  if (figure.varied.empty()) {
    return fmt::format(
        "{} runs, with the same initial conditions for all contact sources; exact {:.0f} % "
        "intervals of the share of runs that finish; root mean square speed of the tyres over the "
        "ground at landings. Oracles read the simulator's state.",
        figure.runs, 100.0 * level);
  }
  return fmt::format(
      "{} runs per point, with the same initial conditions for all contact sources. Bars: exact "
      "{:.0f} % intervals of the share of runs that finish; curves are shifted sideways a little. "
      "Below: root mean square speed of the tyres over the ground at landings. Oracles read the "
      "simulator's state.",
      figure.runs, 100.0 * level);
}

FigureSpec spec_of(const SurvivalFigure& figure, const Table& survival,
                   const Experiment& experiment) {
  FigureSpec spec;
  spec.name = fmt::format("survival_{}_{}{}{}", figure.scene, figure.law,
                          figure.varied.empty() ? "" : "_", figure.varied);
  spec.table = "survival.csv";
  spec.where = {{"scenario", figure.scene}, {"policy", figure.law}, {"varied", figure.varied}};
  const FigureGroups engines =
      groups_in(survival, "simulator", simulators::simulator_title, spec.where);
  const FigureGroups contacts = groups_in(survival, "contact", contact_title, spec.where);
  const FigureAxis finished{.column = "finished",
                            .title = "share of runs that finish",
                            .low = "finished_low",
                            .high = "finished_high",
                            .from = -0.02,
                            .to = 1.02};
  const FigureAxis landing_speed{.column = "landing_speed_rms_mps",
                                 .title = "tyre speed at landings",
                                 .unit = "m/s",
                                 .from = 0.0};
  if (figure.varied.empty()) {
    spec.rows = contacts;
    spec.series = engines;
    spec.measures = {finished,
                     landing_speed,
                     {.column = "false_takeoffs_per_minute",
                      .title = "false takeoffs per minute of contact",
                      .from = 0.0}};
  } else {
    spec.panels = engines;
    spec.series = contacts;
    spec.colour_order = experiment.estimators;
    spec.x = axis_of(figure.varied);
    spec.measures = {finished, landing_speed};
  }
  spec.title =
      fmt::format("Closed-loop results by contact source: {}, {}, {} sensors", figure.scene,
                  figure.law == "soft_landing" ? "soft landing" : figure.law, figure.sensors);
  spec.caption = caption_of(figure, experiment.intervals.bootstrap.level);
  spec.alt = "Share of runs that finish." + values_text(spec, survival);
  return spec;
}

}  // namespace

std::vector<FigureSpec> survival_figures(const Table& survival, const Experiment& experiment) {
  const FigureGroups figures =
      combinations_in(survival, {"scenario", "policy", "varied", "sensors", "runs"},
                      [](const auto&) { return std::string(); });
  std::vector<FigureSpec> specs;
  for (const FigureGroup& of : figures.groups) {
    const std::vector<std::string>& values = of.values;
    specs.push_back(
        spec_of({values[0], values[1], values[2], values[3], values[4]}, survival, experiment));
  }
  return specs;
}

}  // namespace touchdown::experiments
