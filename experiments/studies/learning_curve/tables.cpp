#include "experiments/studies/learning_curve/tables.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/studies/learning_curve/config.hpp"

namespace touchdown::experiments {

namespace {

Columns<LearningCurveRow> learning_curve_columns() {
  using Row = LearningCurveRow;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .part(&Row::noise, noise_columns())
      .text("estimator", &Row::estimator)
      .number("size", &Row::size)
      .text("labelled_s", [](const Row& row) { return fmt::format("{:.3f}", row.labelled); })
      .interval("balanced_accuracy", &Row::balanced_accuracy)
      .metric("success", [](const Row& row) { return row.points.success(); })
      .metric("no_contact_recall", [](const Row& row) { return row.points.no_contact_recall(); })
      .count("draws", &Row::draws)
      .runs("runs", &Row::runs);
}

}  // namespace

void write_tables(const std::vector<LearningCurveRow>& rows, const RunDirectory& directory) {
  directory.write_table("learning_curve.csv", learning_curve_columns(), rows);
}

std::string learning_curve_text(const std::vector<LearningCurveRow>& rows,
                                const Experiment& experiment) {
  const LearningCurveConfig& config = experiment.studies.at<LearningCurveConfig>();
  std::string text = fmt::format(
      "Balanced accuracy by seconds of labelled data, mean over scenes and {} of each size ({}; "
      "{:g} % intervals over training sets and test runs)\n",
      plural(static_cast<std::size_t>(config.draws), "training set"), labels_text(experiment),
      100.0 * experiment.intervals.bootstrap.level);
  const auto engine_and_noise = [](const LearningCurveRow& row) {
    return std::pair(row.simulator, noise_text(row.noise));
  };
  for (const auto& [key, alike] : group_by(rows, engine_and_noise)) {
    Table table = pivot(
        alike,
        [&](const LearningCurveRow& row) { return estimator_title_in(experiment, row.estimator); },
        [](const LearningCurveRow& row) { return fmt::format("{:.1f} s", row.labelled); },
        [](const LearningCurveRow& row) { return with_interval(row.balanced_accuracy); });
    table.header.front() = fmt::format("{}, {}", key.first, key.second);
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

}  // namespace touchdown::experiments
