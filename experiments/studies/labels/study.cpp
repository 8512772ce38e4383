#include "experiments/studies/labels/study.hpp"

#include "core/files.hpp"
#include "experiments/results/text_tables.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/studies/labels/tables.hpp"

namespace touchdown::experiments {

namespace {

class LabelStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override { return experiment.paper_tables; }

  void plan(const RunRequest& /*request*/, Plan& plan) const override {
    add_measure(label_measure(), plan.groups.front());
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<LabelRow> rows = label_rows(evaluation);
    directory.write_table("labels.csv", label_columns(), rows);
    write_atomically(directory.own_file("tables", "labels.md"),
                     to_markdown({"Point-wise scores by the definition of contact" +
                                      setup_caption(evaluation.request.experiment) + ".",
                                  "labels", label_columns().table(rows)}));
    return {};
  }
};

}  // namespace

std::unique_ptr<const Study> label_study() { return std::make_unique<const LabelStudy>(); }

}  // namespace touchdown::experiments
