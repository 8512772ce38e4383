#pragma once

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The key `moments`: torques beside the real robot's.
class MomentsStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override;
  StudyResult summarize(const Evaluation& evaluation, const RunDirectory& directory) const override;
};

}  // namespace touchdown::experiments
