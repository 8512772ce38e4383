#include "experiments/studies/learning_curve/figures.hpp"

#include <fmt/format.h>

#include "experiments/figures/groups.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/studies/learning_curve/config.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

FigureSpec learning_curve_figure(const Table& learning_curve, const Experiment& experiment) {
  FigureSpec spec;
  spec.name = "learning_curve";
  spec.table = "learning_curve.csv";
  spec.panels = combinations_in(
      learning_curve, {"simulator", "torque_noise_nm", "accelerometer_noise_mps2"},
      [](const auto& values) {
        return fmt::format("{}, {} N·m, {} m/s²", simulators::simulator_title(values[0]), values[1],
                           values[2]);
      });
  spec.series = groups_in(learning_curve, "estimator", estimator_title);
  spec.colour_order = experiment.estimators;
  spec.x = {.column = "labelled_s", .title = "labelled data", .unit = "s", .scale = AxisScale::log};
  spec.measures = {{.column = "balanced_accuracy",
                    .title = "balanced accuracy",
                    .low = "balanced_accuracy_low",
                    .high = "balanced_accuracy_high"}};
  spec.title = "Accuracy against the amount of labelled data";
  spec.caption = fmt::format(
      "Balanced accuracy, mean over scenes and {} of each size, of estimators fitted to increasing "
      "amounts of labelled data ({}{}; {:g} % intervals over training sets and test runs). Test "
      "runs "
      "are the same for all sizes.",
      plural(static_cast<std::size_t>(experiment.studies.at<LearningCurveConfig>().draws),
             "training set"),
      labels_text(experiment), setup_caption(experiment),
      100.0 * experiment.intervals.bootstrap.level);
  spec.alt = "Balanced accuracy." + values_text(spec, learning_curve);
  return spec;
}

}  // namespace touchdown::experiments
