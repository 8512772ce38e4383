#include "experiments/run_directory/free_space.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

void require_free_space(const std::filesystem::path& directory, std::uintmax_t needed,
                        const std::string& what_for, const SpaceNeed& need) {
  std::error_code unknown;
  const std::uintmax_t free = std::filesystem::space(directory, unknown).available;
  if (unknown || free >= needed) return;
  throw Error(fmt::format("{}: this {} may need {:.1f} GB{}, and {:.1f} GB are free: {}",
                          directory.string(), need.purpose, 1e-9 * static_cast<double>(needed),
                          what_for.empty() ? "" : fmt::format(" ({})", what_for),
                          1e-9 * static_cast<double>(free), need.advice));
}

}  // namespace touchdown::experiments
