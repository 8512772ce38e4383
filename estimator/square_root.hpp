#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace touchdown {

/// √x to one unit in the last place, for x = 0 and 1e-300 ≤ x ≤ 1e300; below that nearly 0. Made of
/// multiplications and additions only, without a branch, so that loops over it become vector code.
///
/// y ≈ 1/√x to 4 % by halving the exponent in the bits of x. With e = 1 − x y², the root is
/// x y (1 − e)^(−1/2) = x y (1 + e/2 + 3e²/8 + 5e³/16 + …): one step to 6e-6, a second to the end.
inline double square_root(double x) noexcept {
  constexpr double c1 = 1.0 / 2;
  constexpr double c2 = 3.0 / 8;
  constexpr double c3 = 5.0 / 16;
  const double rough =
      std::bit_cast<double>(0x5fe6eb50c7b537a9u - (std::bit_cast<std::uint64_t>(x) >> 1u));
  const double error = 1.0 - (x * rough) * rough;
  const double inverse = rough + rough * error * (c1 + error * (c2 + error * c3));
  const double root = x * inverse;
  const double rest = 1.0 - root * inverse;
  return root + root * rest * (c1 + rest * (c2 + rest * c3));
}

/// root[i] = √square(i) for i < count, which must be even. A processor takes roots in its divider,
/// one vector after the other, while its multipliers wait: half of them by each takes half of the
/// time.
template <typename Square>
void square_roots(int count, const Square& square, double* root) noexcept {
  const int half = count / 2;
  // Nothing that is read overlaps with `root`, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (int i = 0; i < half; ++i) {
    root[i] = std::sqrt(square(i));
    root[half + i] = square_root(square(half + i));
  }
}

}  // namespace touchdown
