#pragma once

#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "logs/recording.hpp"

namespace touchdown::experiments {

/// Seeds from this one on are reserved for reported numbers (docs/explanation/protocol.md). No
/// model may be fitted to a run that was drawn with one.
inline constexpr std::uint64_t first_reserved_seed = 900'000'000;

inline bool is_reserved(std::uint64_t seed) { return seed >= first_reserved_seed; }

/// The seed for drawing fitted runs when test runs are drawn with `seed`.
inline std::uint64_t fit_seed(std::uint64_t seed) { return is_reserved(seed) ? 1 : seed; }

/// Errors: `InputError` when the run was drawn with a reserved seed.
inline void check_may_be_fitted(const logs::RecordingInfo& info) {
  if (!is_reserved(info.seed)) return;
  throw InputError("run " + std::to_string(info.run) + " of scenario '" + info.scenario +
                   "' was drawn with seed " + std::to_string(info.seed) + ": seeds from " +
                   std::to_string(first_reserved_seed) +
                   " on are reserved for reporting and must not be fitted to");
}

}  // namespace touchdown::experiments
