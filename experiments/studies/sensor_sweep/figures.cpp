#include "experiments/studies/sensor_sweep/figures.hpp"

#include <string>

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "experiments/results/value_figure.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

std::vector<FigureSpec> sensor_sweep_figures(const Table& sweep, const Experiment& experiment) {
  std::vector<FigureSpec> specs;
  for (const std::string& simulator : experiment.simulators) {
    FigureSpec spec = accuracy_by_value(sweep, "sensor_sweep", "disturbance", "value (SI units)",
                                        simulator, experiment);
    spec.title =
        fmt::format("Accuracy by sensor disturbance: {}", simulators::simulator_title(simulator));
    spec.caption = fmt::format(
        "Accuracy of both wheels over the values of one disturbance at a time ({}{}; {}; {}). "
        "Estimators are fitted without the disturbance. Values are equally spaced; curves are "
        "shifted sideways a little.",
        noise_text(experiment.highlights.front()), setup_caption(experiment),
        labels_text(experiment), intervals_text(experiment));
    specs.push_back(std::move(spec));
  }
  return specs;
}

}  // namespace touchdown::experiments
