#include "experiments/studies/operating_points/study.hpp"

#include "experiments/studies/operating_points/config.hpp"
#include "experiments/studies/operating_points/figures.hpp"
#include "experiments/studies/operating_points/plan.hpp"
#include "experiments/studies/operating_points/tables.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

class OperatingPointsStudy final : public SectionStudy<OperatingPointsConfig> {
 public:
  std::optional<StudySection> section() const override { return operating_points_section(); }

  void plan(const RunRequest& request, Plan& plan) const override {
    add_measure(operating_points_measure(section_of(request.experiment)), plan.groups.front());
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<OperatingRow> rows = operating_rows(evaluation);
    const std::vector<OperatingMean> means = operating_means(rows);
    write_tables(rows, means, directory);
    const Experiment& experiment = evaluation.request.experiment;
    return {{operating_points_text(means, experiment)},
            {},
            {operating_points_figure(directory.read_table("operating_points.csv"), experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> operating_points_study() {
  return std::make_unique<const OperatingPointsStudy>();
}

}  // namespace touchdown::experiments
