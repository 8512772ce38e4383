#pragma once

#include <array>
#include <cstdint>

#include <Random123/philox.h>

namespace touchdown {

/// Counter-based randomness: 128 random bits that depend on (key, counter) alone. Neither threads
/// nor the order of calls change a draw. Philox4x32-10 of Salmon et al. (2011).
inline std::array<std::uint32_t, 4> philox(std::uint64_t key, std::uint64_t counter_high,
                                           std::uint64_t counter_low) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32U); };
  const r123::Philox4x32::ctr_type bits = r123::Philox4x32{}(
      {{low(counter_low), high(counter_low), low(counter_high), high(counter_high)}},
      {{low(key), high(key)}});
  return {bits[0], bits[1], bits[2], bits[3]};
}

/// Uniform in the open interval (0, 1), from 53 of the random bits.
inline double uniform01(std::uint64_t key, std::uint64_t counter_high, std::uint64_t counter_low) {
  const auto bits = philox(key, counter_high, counter_low);
  const std::uint64_t wide = (std::uint64_t{bits[0]} << 32U) | bits[1];
  return (static_cast<double>(wide >> 11U) + 0.5) * 0x1.0p-53;
}

}  // namespace touchdown
