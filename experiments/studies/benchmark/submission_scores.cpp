#include "experiments/studies/benchmark/submission_scores.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/run_directory/saved_state.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* folder = "state/submissions";

std::string key_for(const RunRequest& request, const std::string& name) {
  return fmt::format("{} submission {}", state_key(request), name);
}

/// Removes the first line of `bytes` and returns it without its line end.
std::string take_line(std::string_view& bytes) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) throw Error("a state file is too short");
  std::string line(bytes.substr(0, end));
  bytes.remove_prefix(end + 1);
  return line;
}

}  // namespace

void save(const SubmissionScores& scores, const RunRequest& request,
          const RunDirectory& directory) {
  std::string bytes;
  for (const auto& by_task : scores.by_cell) {
    bytes += fmt::format("{}\n", by_task.size());
    for (const auto& [task, counts] : by_task)
      bytes += fmt::format("{}\n{}", task, to_bytes(counts));
  }
  write_state(directory.file(folder, scores.name), key_for(request, scores.name), bytes);
}

std::vector<SubmissionScores> saved_submissions(const RunRequest& request,
                                                const RunDirectory& directory) {
  std::vector<SubmissionScores> all;
  for (const std::filesystem::path& entry : entries_in(directory.path() / folder)) {
    SubmissionScores scores{entry.filename().string(), {}};
    const auto bytes = read_state(entry, key_for(request, scores.name));
    if (!bytes) continue;
    std::string_view rest = *bytes;
    for (std::size_t cell = 0; cell < request.experiment.highlights.size(); ++cell) {
      auto& by_task = scores.by_cell.emplace_back();
      for (std::size_t left = std::stoul(take_line(rest)); left > 0; --left) {
        const std::string task = take_line(rest);
        by_task.emplace(task, take_counts(rest));
      }
    }
    all.push_back(std::move(scores));
  }
  std::sort(all.begin(), all.end(),
            [](const SubmissionScores& a, const SubmissionScores& b) { return a.name < b.name; });
  return all;
}

}  // namespace touchdown::experiments
