#include <atomic>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/logs/fit.hpp"
#include "logs/log/recording_file.hpp"
#include "tests/cli/synthetic_log.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

std::atomic<bool> stop = false;

/// A fit that is asked to stop while it computes, and would not end otherwise.
Model endless(const EstimatorEntry& /*entry*/, const FitRuns& runs) {
  stop = true;
  for (;;) runs.before_density();
}

TEST(FitToLogs, StopsWhileItComputes) {
  const ScratchFolder folder;
  logs::write_recording(test::synthetic_log(2.0), folder / "a.mpack");
  const std::vector<FitLog> logs = {{.path = folder / "a.mpack"}};
  const LogFitConfig config{.labels = {}, .stop = &stop};
  LogFitReport report;
  EstimatorEntry entry;
  entry.name = "endless";
  entry.fitting.fit = endless;
  EXPECT_THROW(fit_to_logs(entry, logs, config, report), Stopped);
}

}  // namespace
}  // namespace touchdown::experiments
