#pragma once

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `closed_loop`: runs with contact feedback to the policy.
class ClosedLoopStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override;
  void plan(const RunRequest& request, Plan& plan) const override;
  StudyResult summarize(const Evaluation& evaluation, const RunDirectory& directory) const override;
};

}  // namespace touchdown::experiments
