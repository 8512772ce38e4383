#pragma once

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `benchmark`: estimators scene by scene, on several robots and sensors.
class BenchmarkStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override;
  void add_needs(const RunRequest& request, Needs& needs) const override;
  void plan(const RunRequest& request, Plan& plan) const override;
  StudyResult summarize(const Evaluation& evaluation, const RunDirectory& directory) const override;
};

}  // namespace touchdown::experiments
