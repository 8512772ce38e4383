#include "experiments/studies/odometry/study.hpp"

#include "experiments/studies/odometry/figures.hpp"
#include "experiments/studies/odometry/plan.hpp"
#include "experiments/studies/odometry/tables.hpp"
#include "experiments/studies/odometry/trajectories.hpp"

namespace touchdown::experiments {

bool OdometryStudy::is_requested(const Experiment& experiment) const {
  return experiment.odometry.has_value();
}

void OdometryStudy::add_needs(const RunRequest& /*request*/, Needs& needs) const {
  needs.motion = true;
}

void OdometryStudy::plan(const RunRequest& request, Plan& plan) const {
  add_odometry_study(request, plan);
  const Experiment& experiment = request.experiment;
  add_measure(trajectories(*experiment.odometry, experiment.test.runs), plan.groups.front());
}

StudyResult OdometryStudy::summarize(const Evaluation& evaluation,
                                     const RunDirectory& directory) const {
  const std::vector<OdometryRow> rows = odometry_rows(evaluation);
  write_tables(rows, directory);
  write_trajectories(evaluation, directory);
  const Experiment& experiment = evaluation.request.experiment;
  return {{odometry_text(rows, experiment)},
          {},
          odometry_figures(directory.read_table("odometry.csv"), experiment)};
}

}  // namespace touchdown::experiments
