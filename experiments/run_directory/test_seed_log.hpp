#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace touchdown::experiments {

/// One evaluation on a reserved seed: one configuration, computed by one build.
struct TestSeedUse {
  std::uint64_t seed = 0;
  std::string id;      ///< of the request
  std::string commit;  ///< of the build
};

/// Logs an evaluation in `reserved_seeds.csv` beside the run directory: reserved seeds are for
/// numbers that are reported once. Returns the number of other logged evaluations of this seed. The
/// same evaluation again is logged once. Errors: `Error` when the log cannot be written.
int log_evaluation(const std::filesystem::path& run_directory, const TestSeedUse& use);

}  // namespace touchdown::experiments
