#include "experiments/studies/learning_curve/study.hpp"

#include "experiments/studies/learning_curve/config.hpp"
#include "experiments/studies/learning_curve/figures.hpp"
#include "experiments/studies/learning_curve/plan.hpp"
#include "experiments/studies/learning_curve/tables.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

class LearningCurveStudy final : public SectionStudy<LearningCurveConfig> {
 public:
  std::optional<StudySection> section() const override { return learning_curve_section(); }

  void add_needs(const RunRequest& /*request*/, Needs& needs) const override {
    needs.setups += 1.0;  // the signals of the test runs are kept once more
  }

  void plan(const RunRequest& request, Plan& plan) const override {
    add_learning_curve(request, plan);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<LearningCurveRow> rows = learning_curve_rows(evaluation);
    write_tables(rows, directory);
    const Experiment& experiment = evaluation.request.experiment;
    return {{learning_curve_text(rows, experiment)},
            {},
            {learning_curve_figure(directory.read_table("learning_curve.csv"), experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> learning_curve_study() {
  return std::make_unique<const LearningCurveStudy>();
}

}  // namespace touchdown::experiments
