#include "experiments/studies/sensor_sweep/figures.hpp"

#include <string>

#include <fmt/format.h>

#include "experiments/figures/groups.hpp"
#include "experiments/results/captions.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

std::vector<FigureSpec> sensor_sweep_figures(const Table& sweep, const Experiment& experiment) {
  std::vector<FigureSpec> specs;
  for (const std::string& simulator : experiment.simulators) {
    FigureSpec spec;
    spec.name = "sensor_sweep_" + simulator;
    spec.table = "sensor_sweep.csv";
    spec.where = {{"simulator", simulator}};
    spec.panels = groups_in(
        sweep, "disturbance", [](const auto& key) { return key; }, spec.where);
    spec.series = groups_in(sweep, "estimator", estimator_title, spec.where);
    spec.colour_order = experiment.estimators;
    spec.x = {.column = "value", .title = "value (SI units)", .scale = AxisScale::ordinal};
    spec.measures = {
        {.column = "success", .title = "accuracy", .low = "success_low", .high = "success_high"}};
    spec.title =
        fmt::format("Accuracy by sensor disturbance: {}", simulators::simulator_title(simulator));
    spec.caption = fmt::format(
        "Accuracy of both wheels over the values of one disturbance at a time ({}{}; {}; {}). "
        "Estimators are fitted without the disturbance. Values are equally spaced; curves are "
        "shifted sideways a little.",
        noise_text(experiment.highlights.front()), setup_caption(experiment),
        labels_text(experiment), intervals_text(experiment));
    spec.alt = "Accuracy." + values_text(spec, sweep);
    specs.push_back(std::move(spec));
  }
  return specs;
}

}  // namespace touchdown::experiments
