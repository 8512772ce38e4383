#pragma once

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `operating_points`: decisions at other thresholds of P(contact).
class OperatingPointsStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override;
  void plan(const RunRequest& request, Plan& plan) const override;
  StudyResult summarize(const Evaluation& evaluation, const RunDirectory& directory) const override;
};

}  // namespace touchdown::experiments
