#include "experiments/studies/odometry/study.hpp"

#include "experiments/studies/odometry/config.hpp"
#include "experiments/studies/odometry/figures.hpp"
#include "experiments/studies/odometry/plan.hpp"
#include "experiments/studies/odometry/tables.hpp"
#include "experiments/studies/odometry/trajectories.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

class OdometryStudy final : public SectionStudy<OdometryStudyConfig> {
 public:
  std::optional<StudySection> section() const override { return odometry_section(); }

  void add_needs(const RunRequest& /*request*/, Needs& needs) const override {
    needs.motion = true;
  }

  void plan(const RunRequest& request, Plan& plan) const override {
    add_odometry_study(request, plan);
    const Experiment& experiment = request.experiment;
    add_measure(trajectories(section_of(experiment), experiment.test.runs), plan.groups.front());
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<OdometryRow> rows = odometry_rows(evaluation);
    write_tables(rows, directory);
    write_trajectories(evaluation, directory);
    const Experiment& experiment = evaluation.request.experiment;
    return {{odometry_text(rows, experiment)},
            {},
            odometry_figures(directory.read_table("odometry.csv"), experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> odometry_study() { return std::make_unique<const OdometryStudy>(); }

}  // namespace touchdown::experiments
