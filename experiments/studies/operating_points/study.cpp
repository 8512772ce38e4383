#include "experiments/studies/operating_points/study.hpp"

#include "experiments/studies/operating_points/figures.hpp"
#include "experiments/studies/operating_points/plan.hpp"
#include "experiments/studies/operating_points/tables.hpp"

namespace touchdown::experiments {

bool OperatingPointsStudy::is_requested(const Experiment& experiment) const {
  return experiment.operating_points.has_value();
}

void OperatingPointsStudy::plan(const RunRequest& request, Plan& plan) const {
  add_measure(operating_points_measure(*request.experiment.operating_points), plan.groups.front());
}

StudyResult OperatingPointsStudy::summarize(const Evaluation& evaluation,
                                            const RunDirectory& directory) const {
  const std::vector<OperatingRow> rows = operating_rows(evaluation);
  const std::vector<OperatingMean> means = operating_means(rows);
  write_tables(rows, means, directory);
  const Experiment& experiment = evaluation.request.experiment;
  return {{operating_points_text(means, experiment)},
          {},
          {operating_points_figure(directory.read_table("operating_points.csv"), experiment)}};
}

}  // namespace touchdown::experiments
