#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace touchdown {

/// √x to one unit in the last place, for x = 0 and 1e-300 ≤ x ≤ 1e300; nearly 0 for smaller x. It
/// consists of multiplications and additions without a branch, so that loops over it become vector
/// code.
///
/// y ≈ 1/√x to 3.5 % by halving the exponent in the bits of x. With e = 1 − x y², the root is
/// x y (1 − e)^(−1/2) = x y (1 + e/2 + 3e²/8 + 5e³/16 + …). One step reaches 1e-6, with the last
/// two coefficients optimised for |e| < 0.07. A second step reaches full precision.
inline double square_root(double x) noexcept {
  const double rough =
      std::bit_cast<double>(0x5fe6eb50c7b537a9u - (std::bit_cast<std::uint64_t>(x) >> 1u));
  const double error = 1.0 - (x * rough) * rough;
  const double inverse = rough + rough * error * (0.5 + error * (0.37608 + error * 0.31347));
  const double root = x * inverse;
  const double rest = 1.0 - root * inverse;
  return root + root * rest * (0.5 + rest * 0.375);
}

/// Calls sink(i, √square(i)) for i < count. A processor computes roots in its divider, one vector
/// at a time, while its multipliers wait. Half of the roots here use multipliers instead, which
/// takes half of the time. `square` must not read what `sink` writes.
template <typename Square, typename Sink>
void square_roots(int count, const Square& square, const Sink& sink) noexcept {
  const int half = count / 8 * 4;
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (int i = 0; i < half; ++i) {
    sink(i, std::sqrt(square(i)));
    sink(half + i, square_root(square(half + i)));
  }
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (int i = 2 * half; i < count; ++i) sink(i, square_root(square(i)));
}

}  // namespace touchdown
