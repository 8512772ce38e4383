#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace touchdown::experiments {

/// What needs the space, and the advice if there is too little.
struct SpaceNeed {
  const char* purpose = "run";
  const char* advice =
      "free some (`touchdown clean` removes old runs), keep fewer recordings (--set "
      "recordings=pictured), reduce the number of parts, or use another disk (--out)";
};

/// Checks the disk before anything is computed. Errors: `Error` when the directory's disk has fewer
/// free bytes than `needed`; the message includes `what_for`.
void require_free_space(const std::filesystem::path& directory, std::uintmax_t needed,
                        const std::string& what_for = "", const SpaceNeed& need = {});

}  // namespace touchdown::experiments
