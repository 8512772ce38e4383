#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// The scores of a submitted estimator in a benchmark, by highlighted noise setting, then by task
/// name. Tasks without submitted beliefs are missing.
struct SubmissionScores {
  std::string name;
  std::vector<std::map<std::string, TaskCounts>> by_cell;
};

/// Saves the scores in the run directory; replaces those of the same name.
void save(const SubmissionScores& scores, const RunRequest& request, const RunDirectory& directory);

/// The scores that this build saved for this request, by name.
std::vector<SubmissionScores> saved_submissions(const RunRequest& request,
                                                const RunDirectory& directory);

}  // namespace touchdown::experiments
