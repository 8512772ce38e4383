#pragma once

#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/plan/needs.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// What a study found, besides its files.
struct StudyResult {
  std::vector<std::string> texts = {};           ///< for the terminal
  std::vector<std::string> failed_demands = {};  ///< estimators that fail a demanded verdict
  std::vector<FigureSpec> figures = {};          ///< of its tables
};

/// One question that an experiment file can ask beside the scores of every experiment: what it adds
/// to the plan, and what it makes of the evaluation. Studies have no state; `studies()` lists them.
class Study {
 public:
  Study() = default;
  virtual ~Study() = default;
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  /// Whether the experiment file asks for it.
  virtual bool is_requested(const Experiment& experiment) const = 0;

  /// Adds what it will need, before anything is planned.
  virtual void add_needs(const RunRequest& /*request*/, Needs& /*needs*/) const {}

  /// Adds runs, groups, measures and model tasks. Errors: `InputError` for a wrong request.
  virtual void plan(const RunRequest& /*request*/, Plan& /*plan*/) const {}

  /// Writes its tables and returns its texts. Computes nothing that a task could have computed.
  virtual StudyResult summarize(const Evaluation& evaluation,
                                const RunDirectory& directory) const = 0;
};

}  // namespace touchdown::experiments
