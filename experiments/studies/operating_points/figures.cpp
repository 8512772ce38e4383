#include "experiments/studies/operating_points/figures.hpp"

#include <string>

#include <fmt/format.h>

#include "experiments/figures/groups.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

namespace {

constexpr double fewest = 0.3;  // extra switches per minute: the axis begins here

/// Error and extra switches of each estimator's own decision.
std::string own_decisions_text(const FigureSpec& spec, const Table& table) {
  std::string text;
  for (std::size_t panel = 0; panel < spec.panels.groups.size(); ++panel) {
    text += fmt::format(" {}:", spec.panels.groups[panel].title);
    for (const std::vector<std::string>& row : table.rows) {
      if (group_of(spec.panels, table, row) != panel) continue;
      if (!cell(table, row, "leave_below").empty()) continue;
      const auto value = [&](const FigureAxis& axis) {
        return drawn_value(axis, cell(table, row, axis.column));
      };
      text += fmt::format(" {} by its own decision {:.2f} % with {:.1f} per minute;",
                          estimator_title(cell(table, row, "estimator")),
                          value(spec.measures.front()), value(spec.x));
    }
    text.back() = '.';
  }
  return text;
}

}  // namespace

FigureSpec operating_points_figure(const Table& operating_points, const Experiment& experiment) {
  FigureSpec spec;
  spec.name = "operating_points";
  spec.table = "operating_points.csv";
  spec.panels = combinations_in(
      operating_points, {"torque_noise_nm", "accelerometer_noise_mps2"},
      [](const auto& noise) { return fmt::format("{} N·m, {} m/s²", noise[0], noise[1]); });
  spec.series = groups_in(operating_points, "estimator", estimator_title);
  spec.colour_order = experiment.estimators;
  spec.x = {.column = "extra_switches_per_minute",
            .title = "extra switches per minute",
            .scale = AxisScale::log,
            .floor = fewest};
  spec.measures = {{.column = "balanced_accuracy",
                    .title = "1 − balanced accuracy",
                    .unit = "%",
                    .scale = AxisScale::log,
                    .factor = -100.0,
                    .offset = 100.0}};
  spec.marks = {{MarkShape::curve, {{"on_front", "1"}}}, {MarkShape::ring, {{"leave_below", ""}}}};
  spec.title = "Balanced error against extra switches";
  spec.caption = fmt::format(
      "1 − balanced accuracy against extra switches of the decision, both averaged over scenes and "
      "engines ({}). Each curve is the Pareto front of one estimator over decision thresholds on "
      "its P(contact); a ring marks its own thresholds. Values below {} extra switches per minute "
      "are drawn at that value.",
      labels_text(experiment), fewest);
  spec.alt = "Error against extra switches." + own_decisions_text(spec, operating_points);
  return spec;
}

}  // namespace touchdown::experiments
