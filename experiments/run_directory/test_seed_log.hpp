#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace touchdown::experiments {

/// Who scored runs of a reserved seed: one configuration as one build computed it.
struct TestSeedUse {
  std::uint64_t seed = 0;
  std::string id;      ///< of the request
  std::string commit;  ///< of the build
};

/// Reserved seeds are for numbers that are reported once. Notes in `reserved_seeds.csv` beside the
/// run directory that its runs were scored, and returns how many others did that before; the same
/// one again counts once. Errors: `Error` when it cannot be noted.
int log_evaluation(const std::filesystem::path& run_directory, const TestSeedUse& touch);

}  // namespace touchdown::experiments
