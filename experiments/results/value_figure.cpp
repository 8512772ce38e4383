#include "experiments/results/value_figure.hpp"

#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

FigureSpec accuracy_by_value(const Table& table, const std::string& name, const std::string& varied,
                             const std::string& value_title, const std::string& simulator,
                             const Experiment& experiment) {
  FigureSpec spec;
  spec.name = name + "_" + simulator;
  spec.table = name + ".csv";
  spec.where = {{"simulator", simulator}};
  spec.panels = groups_in(
      table, varied, [](const auto& text) { return text; }, spec.where);
  spec.series = groups_in(table, "estimator", titles_in(experiment), spec.where);
  spec.colour_order = experiment.estimators;
  spec.x = {.column = "value", .title = value_title, .scale = AxisScale::ordinal};
  spec.measures = {axis_with_interval("success", "success rate")};
  spec.alt = "Success rate." + values_text(spec, table);
  return spec;
}

}  // namespace touchdown::experiments
