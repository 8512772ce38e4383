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
  const Table labels = label_table(evaluation);
  directory.write_table("labels.csv", labels);
  write_atomically(directory.file("tables", "labels.md"),
                   to_markdown({"Point-wise scores by the definition of contact" +
                                    setup_caption(evaluation.request.experiment) + ".",
                                "labels", labels}));
  return {};
}

}  // namespace touchdown::experiments
