#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/store.hpp"

namespace touchdown::experiments {

/// The scores of a submitted estimator in a benchmark, by highlighted noise setting, then by task
/// name. Tasks without submitted beliefs are missing.
struct SubmissionScores {
  std::string name;
  std::vector<std::map<std::string, TaskCounts>> by_cell;
};

/// Saves the scores; replaces those of the same name.
void save(const SubmissionScores& scores, const Store& store);

/// The saved scores of all submissions, by name.
std::vector<SubmissionScores> saved_submissions(const Store& store);

}  // namespace touchdown::experiments
