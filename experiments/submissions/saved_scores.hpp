#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// What an estimator that is none of ours scored in a benchmark: by highlighted noise setting, then
/// by the name of the task; nothing for tasks that it handed nothing in for.
struct SubmissionScores {
  std::string name;
  std::vector<std::map<std::string, TaskCounts>> by_cell;
};

/// Keeps it in the run directory, in place of what had the same name.
void save(const SubmissionScores& scores, const RunRequest& request, const RunDirectory& directory);

/// Those that were kept there for this request by this build, by name.
std::vector<SubmissionScores> saved_submissions(const RunRequest& request, const RunDirectory& directory);

}  // namespace touchdown::experiments
