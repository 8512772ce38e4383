#pragma once

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `cross_simulator`: agreement of the engines, transfer and sensitivity.
class CrossSimulatorStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override;
  void add_needs(const RunRequest& request, Needs& needs) const override;
  void plan(const RunRequest& request, Plan& plan) const override;
  StudyResult summarize(const Evaluation& evaluation, const RunDirectory& directory) const override;
};

}  // namespace touchdown::experiments
