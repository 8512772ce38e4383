#include "experiments/studies/cross_simulator/figures.hpp"

#include <string>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/figures/groups.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/value_figure.hpp"
#include "experiments/studies/cross_simulator/config.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The series of a transfer: fitted in one engine and tested in the other.
FigureGroups directions(const Experiment& experiment) {
  FigureGroups groups{{"fit_simulator", "test_simulator"}, {}};
  for (const std::string& fit : experiment.simulators) {
    for (const std::string& test : experiment.simulators) {
      if (fit == test) continue;
      groups.groups.push_back({{fit, test},
                               fmt::format("{} → {}", simulators::simulator_title(fit),
                                           simulators::simulator_title(test))});
    }
  }
  return groups;
}

}  // namespace

FigureSpec transfer_figure(const Table& transfer, const Experiment& experiment) {
  FigureSpec spec;
  spec.name = "transfer";
  spec.table = "transfer.csv";
  spec.where = {{"is_fitted", "1"}};
  spec.panels = combinations_in(
      transfer, {"torque_noise_nm", "accelerometer_noise_mps2"},
      [](const auto& noise) { return fmt::format("{} N·m, {} m/s²", noise[0], noise[1]); });
  spec.series = directions(experiment);
  spec.rows = groups_in(transfer, "estimator", estimator_title, spec.where);
  spec.measures = {axis_with_interval("loss", "loss of accuracy"),
                   axis_with_interval("gain", "gain over always contact")};
  spec.title = "Transfer between the engines";
  spec.caption = fmt::format(
      "Estimators fitted in one engine and tested in the other, \"fitted → tested\". Loss: "
      "accuracy "
      "of the same estimator fitted in the test engine, minus this one's, on the same runs. Gain: "
      "accuracy minus that of always contact ({}{}; {}).",
      labels_text(experiment), setup_caption(experiment), intervals_text(experiment));
  spec.alt = "Loss of accuracy when fitted in the other engine." + values_text(spec, transfer);
  return spec;
}

std::vector<FigureSpec> sensitivity_figures(const Table& sensitivity,
                                            const Experiment& experiment) {
  std::vector<FigureSpec> specs;
  for (const std::string& simulator : experiment.simulators) {
    FigureSpec spec = accuracy_by_value(sensitivity, "sensitivity", "factor", "value of the factor",
                                        simulator, experiment);
    spec.title =
        fmt::format("Sensitivity of the accuracy: {}", simulators::simulator_title(simulator));
    spec.caption = fmt::format(
        "Accuracy of estimators fitted on the nominal scene, one factor at a time, {} runs each "
        "({}; {}{}; {}). Values are equally spaced; curves are shifted sideways a little.",
        experiment.studies.at<CrossSimulatorConfig>().sensitivity_runs,
        noise_text(experiment.highlights.front()), labels_text(experiment),
        setup_caption(experiment), intervals_text(experiment));
    if (!spec.panels.groups.empty()) specs.push_back(std::move(spec));
  }
  return specs;
}

}  // namespace touchdown::experiments
