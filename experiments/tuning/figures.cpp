#include "experiments/tuning/figures.hpp"

#include <string>

#include <fmt/format.h>

#include "experiments/config/experiment_estimators.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

FigureSpec tuning_figure(const Table& tuning, const Experiment& experiment) {
  FigureSpec spec;
  spec.name = "tuning";
  spec.table = "tuning.csv";
  spec.panels = groups_in(tuning, "fit", [](const auto& name) { return name; });
  spec.series = groups_in(tuning, "simulator", simulators::simulator_title);
  spec.rows = groups_in(tuning, "estimator",
                        [&](const auto& name) { return estimator_entry(experiment, name).title; });
  spec.measures = {{.column = "balanced_accuracy", .title = "balanced accuracy"}};
  spec.marks = {{MarkShape::points, {}},
                {MarkShape::cross, {{"trial", "0"}}},
                {MarkShape::ring, {{"chosen", "1"}}}};
  spec.title = "Hyperparameter trials";
  spec.caption = fmt::format(
      "A point per trial of an estimator's hyperparameters: balanced accuracy, mean over scenes, "
      "of "
      "the fitted runs in {}-fold cross-validation. A cross marks the defaults, a ring the chosen "
      "values (tables/tuning.csv).",
      experiment.tuning->folds);
  FigureSpec chosen = spec;
  chosen.where = {{"chosen", "1"}};
  spec.alt = "Balanced accuracy of the chosen trials." + values_text(chosen, tuning);
  return spec;
}

}  // namespace touchdown::experiments
