#pragma once

#include <bit>
#include <cstdint>

namespace touchdown {

/// e^x to two units in the last place, for |x| ≤ 700. Beyond that it is the value at ±700, so that
/// nothing overflows. It has no branch and no call, so that loops over it become vector code, and
/// one filter gives the same bits as many side by side. NaN gives e^−700.
///
/// x = k·ln 2 + r with |r| ≤ ln 2 / 2; e^r by its Taylor polynomial of degree 13 (remainder below
/// 5e-18); 2^k by writing k into an exponent.
inline double exponential(double x) noexcept {
  constexpr double limit = 700.0;
  constexpr double inverse_ln2 = 1.4426950408889634;
  // ln 2 in two parts, the first with enough trailing zeros that k · ln2_high is exact.
  constexpr double ln2_high = 0x1.62e42fee00000p-1;
  constexpr double ln2_low = 0x1.a39ef35793c76p-33;
  // Adding 1.5·2^52 rounds to an integer and leaves it in the low bits.
  constexpr double shifter = 0x1.8p52;

  const double above = x > -limit ? x : -limit;
  const double bounded = above < limit ? above : limit;
  const double shifted = bounded * inverse_ln2 + shifter;
  const double k = shifted - shifter;
  const double r = (bounded - k * ln2_high) - k * ln2_low;

  const double r2 = r * r;
  const double r4 = r2 * r2;
  const double r8 = r4 * r4;
  const double c01 = 1.0 + r;
  const double c23 = 1.0 / 2 + r * (1.0 / 6);
  const double c45 = 1.0 / 24 + r * (1.0 / 120);
  const double c67 = 1.0 / 720 + r * (1.0 / 5040);
  const double c89 = 1.0 / 40320 + r * (1.0 / 362880);
  const double c1011 = 1.0 / 3628800 + r * (1.0 / 39916800);
  const double c1213 = 1.0 / 479001600 + r * (1.0 / 6227020800.0);
  const double low = (c01 + r2 * c23) + r4 * (c45 + r2 * c67);
  const double high = (c89 + r2 * c1011) + r4 * c1213;
  const double polynomial = low + r8 * high;

  const auto exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023u) << 52;
  return polynomial * std::bit_cast<double>(exponent);
}

}  // namespace touchdown
