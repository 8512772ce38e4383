#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace touchdown::experiments {

/// Who needs the space, and what to do where it is short.
struct SpaceNeed {
  const char* who = "run";
  const char* advice =
      "free some (`touchdown clean` removes old runs), keep fewer recordings (--set "
      "recordings=pictured), lower what asks for so many parts, or put it elsewhere (--out)";
};

/// Errors: `Error` when the disk that holds the directory has fewer bytes free than `needed`, with
/// what they are for. Before anything is computed is the time to say so.
void require_free_space(const std::filesystem::path& directory, std::uintmax_t needed,
                        const std::string& what_for = "", const SpaceNeed& need = {});

}  // namespace touchdown::experiments
