#include "experiments/studies/benchmark/submission_scores.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* submission_parts = "submissions";

using CountsByCell = std::vector<std::map<std::string, TaskCounts>>;

}  // namespace

void save(const SubmissionScores& scores, const Store& store) {
  store.put(submission_parts, scores.name, scores.by_cell);
}

std::vector<SubmissionScores> saved_submissions(const Store& store) {
  std::vector<SubmissionScores> all;
  for (const std::string& name : store.names(submission_parts)) {
    std::optional<CountsByCell> by_cell = store.find<CountsByCell>(submission_parts, name);
    if (by_cell) all.push_back({name, *std::move(by_cell)});
  }
  return all;
}

}  // namespace touchdown::experiments
