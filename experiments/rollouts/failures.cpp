#include "experiments/rollouts/failures.hpp"

#include <set>

#include <fmt/format.h>

namespace touchdown::experiments {

std::string failures_text(const std::map<std::string, std::string>& ending_by_file) {
  if (ending_by_file.empty()) return "there is none";
  const auto& [file, ending] = *ending_by_file.begin();
  const std::size_t others = ending_by_file.size() - 1;
  const std::string more =
      others == 0 ? "" : fmt::format(", and {} other{}", others, others == 1 ? "" : "s");
  return fmt::format("{} {}{}", file, ending, more);
}

std::string unused_runs_text(const std::vector<Rollout>& runs) {
  std::string text;
  std::set<std::string> named;
  for (const Rollout& run : runs) {
    if (!run.failed() || !named.insert(run.plan.file).second) continue;
    text += fmt::format("Not used: {} ({})\n", run.plan.file, run.report.ending);
  }
  return text;
}

}  // namespace touchdown::experiments
