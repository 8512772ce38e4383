#pragma once

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// How point-wise scores change with the definition of contact, beside the paper's tables.
class LabelStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override;
  void plan(const RunRequest& request, Plan& plan) const override;
  StudyResult summarize(const Evaluation& evaluation, const RunDirectory& directory) const override;
};

}  // namespace touchdown::experiments
