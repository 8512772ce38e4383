#pragma once

#include <optional>

#include "experiments/config/experiment_yaml.hpp"
#include "experiments/evaluation/scored.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// One question that an experiment file can ask beside the scores of every experiment: what it adds
/// to the plan, and what it makes of the evaluation. Studies have no state; `studies()` lists them.
class Study {
 public:
  Study() = default;
  virtual ~Study() = default;
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  /// Its section of experiment files. Without one, another key asks for the study.
  virtual std::optional<StudySection> section() const { return std::nullopt; }

  virtual bool is_requested(const Experiment& experiment) const = 0;

  /// Adds runs, groups, measures and model tasks. Errors: `InputError` for a wrong request.
  virtual void plan(const RunRequest& /*request*/, Plan& /*plan*/) const {}

  /// Writes its tables and returns its texts. Computes nothing that a task could have computed.
  virtual StudyResult summarize(const Evaluation& evaluation,
                                const RunDirectory& directory) const = 0;
};

/// A study that an experiment file asks for by having its section.
template <typename Section>
class SectionStudy : public Study {
 public:
  bool is_requested(const Experiment& experiment) const final {
    return experiment.studies.has<Section>();
  }

 protected:
  static const Section& section_of(const Experiment& experiment) {
    return experiment.studies.at<Section>();
  }
};

}  // namespace touchdown::experiments
