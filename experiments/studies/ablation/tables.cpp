#include "experiments/studies/ablation/tables.hpp"

#include <limits>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

namespace {

Interval gain_of(const AblationRow& row) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return row.gain.value_or(Interval{none, none, none});
}

Columns<AblationRow> ablation_columns() {
  using Row = AblationRow;
  return Columns<Row>()
      .part(&Row::noise, noise_columns())
      .text("estimator", &Row::estimator)
      .text("before", &Row::before)
      .interval("balanced_accuracy", &Row::balanced_accuracy)
      .interval("gain", gain_of)
      .runs("runs", &Row::runs);
}

}  // namespace

void write_tables(const std::vector<AblationRow>& rows, const RunDirectory& directory) {
  directory.write_table("ablation.csv", ablation_columns(), rows);
}

std::string ablation_text(const std::vector<AblationRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format(
      "Balanced accuracy of every step and its gain over the step before, mean over scenes and "
      "engines ({}; {})\n",
      labels_text(experiment), intervals_text(experiment));
  for (const auto& alike : group_by(rows, [](const AblationRow& row) { return row.noise; })) {
    Table table{{noise_text(alike.key), "balanced accuracy", "gain"}, {}};
    for (const AblationRow& row : alike.rows) {
      table.rows.push_back({estimator_title_in(experiment, row.estimator),
                            with_interval(row.balanced_accuracy), with_interval(gain_of(row))});
    }
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

}  // namespace touchdown::experiments
