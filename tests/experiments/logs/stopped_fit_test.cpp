#include <atomic>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/logs/fit.hpp"
#include "logs/log/recording_file.hpp"
#include "tests/cli/synthetic_log.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

TEST(FitToLogs, StopsIfItIsAskedToBeforeItReadsALog) {
  const ScratchFolder folder;
  logs::write_recording(test::synthetic_log(2.0), folder / "a.mpack");
  const std::vector<FitLog> logs = {{.path = folder / "a.mpack"}};
  const std::atomic<bool> stop = true;
  const LogFitConfig config{.labels = {}, .stop = &stop};
  LogFitReport report;
  EXPECT_THROW(fit_to_logs(estimator_entry("robust"), logs, config, report), Stopped);
}

}  // namespace
}  // namespace touchdown::experiments
