#pragma once

namespace touchdown {

struct SineCosine {
  double sine;
  double cosine;
};

/// sin x and cos x to two units in the last place of 1, for |x| ≤ 10⁵ rad. It has no branch and no
/// call, so that loops over it become vector code; a bound in here would bring branches back.
///
/// x = k·π/2 + r with |r| ≤ π/4. π/2 comes in three parts; the products of k with the first two are
/// exact. Taylor polynomials of r go up to r¹⁵ and r¹⁶ (remainders below 5e-17). k mod 4 decides
/// which of the two is the sine, and the signs.
inline SineCosine sine_and_cosine(double x) noexcept {
  constexpr double inverse_half_pi = 0x1.45f306dc9c883p-1;
  constexpr double half_pi_high = 0x1.921fb54400000p+0;
  constexpr double half_pi_middle = 0x1.0b4611a600000p-34;
  constexpr double half_pi_low = 0x1.3198a2e037073p-69;
  // Adding 1.5·2^52 rounds to an integer.
  constexpr double shifter = 0x1.8p52;

  const double k = (x * inverse_half_pi + shifter) - shifter;
  const double r = ((x - k * half_pi_high) - k * half_pi_middle) - k * half_pi_low;
  const double r2 = r * r;
  const double odd =
      r + r * r2 *
              (-1.0 / 6 +
               r2 * (1.0 / 120 +
                     r2 * (-1.0 / 5040 +
                           r2 * (1.0 / 362880 +
                                 r2 * (-1.0 / 39916800 + r2 * (1.0 / 6227020800.0 -
                                                               r2 * (1.0 / 1307674368000.0)))))));
  const double even =
      1.0 +
      r2 * (-1.0 / 2 +
            r2 * (1.0 / 24 +
                  r2 * (-1.0 / 720 +
                        r2 * (1.0 / 40320 + r2 * (-1.0 / 3628800 +
                                                  r2 * (1.0 / 479001600 +
                                                        r2 * (-1.0 / 87178291200.0 +
                                                              r2 * (1.0 / 20922789888000.0))))))));
  // 0, 1, 2 or 3 quarters beyond a whole turn; no rounded number lies halfway. Products by 0 and 1
  // select the polynomial, because compilers would branch on a condition.
  const double turns = ((k * 0.25 - 0.375) + shifter) - shifter;
  const double quarter = k - 4.0 * turns;
  const double halves = ((quarter * 0.5 - 0.25) + shifter) - shifter;
  const double is_swapped = quarter - 2.0 * halves;
  const double is_not = 1.0 - is_swapped;
  const double sign = 1.0 - 2.0 * halves;
  return {sign * (is_swapped * even + is_not * odd),
          sign * (is_not - is_swapped) * (is_swapped * odd + is_not * even)};
}

}  // namespace touchdown
