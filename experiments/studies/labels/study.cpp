#include "experiments/studies/labels/study.hpp"

#include "core/files.hpp"
#include "experiments/plan/sensors.hpp"
#include "experiments/results/paper.hpp"
#include "experiments/studies/labels/tables.hpp"

namespace touchdown::experiments {

bool LabelStudy::is_requested(const Experiment& experiment) const {
  return experiment.paper_tables;
}

void LabelStudy::plan(const RunRequest& /*request*/, Plan& plan) const {
  add_measure(label_measure(), plan.groups.front());
}

StudyResult LabelStudy::summarize(const Evaluation& evaluation,
                                  const RunDirectory& directory) const {
  const std::vector<LabelRow> rows = label_rows(evaluation);
  directory.write_table("labels.csv", label_columns(), rows);
  write_atomically(directory.file("tables", "labels.md"),
                   to_markdown({"Point-wise scores by the definition of contact" +
                                    setup_caption(evaluation.request.experiment) + ".",
                                "labels", label_columns().table(rows)}));
  return {};
}

}  // namespace touchdown::experiments
