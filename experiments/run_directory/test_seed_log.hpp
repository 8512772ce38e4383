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

/// The log of this checkout, wherever run directories are: `runs/reserved_seeds.csv` in the sources
/// that the program was built from or, without sources, in the working directory.
std::filesystem::path test_seed_log();

/// Logs an evaluation, since reserved seeds are for numbers that are reported once. Returns the
/// number of other logged evaluations of this seed. The same evaluation again is logged once. The
/// log's folder is created if needed. Errors: `Error` when the log cannot be written.
int log_evaluation(const std::filesystem::path& log, const TestSeedUse& use);

}  // namespace touchdown::experiments
