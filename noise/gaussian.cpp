#include "noise/gaussian.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/random.hpp"

// This file does not call the C library's logarithm or sine: their last bits differ between
// libraries, and they do not vectorise. Additions, multiplications, divisions and square roots give
// the same bits on every machine.

namespace touchdown::noise {

namespace {

struct Pair {
  double first;
  double second;
};

/// Uniform in [1, 2) from 52 of the bits.
inline double from_one_to_two(std::uint64_t bits) {
  return std::bit_cast<double>((bits >> 12U) | 0x3ff0000000000000U);
}

/// −ln(x) for x in (0, 1], normal numbers. x = m·2^e with m in [√½, √2), and
/// ln m = 2 artanh((m − 1)/(m + 1)) as a power series.
inline double minus_log(double x) {
  constexpr std::uint64_t sqrt_half = 0x3fe6a09e667f3bcdU;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t above = bits - sqrt_half + (std::uint64_t{1} << 62U);
  // The exponent e, as the integer e + 2^10, as a double: by the bits of 2^52 + integer.
  const std::uint64_t exponent = above >> 52U;
  const double e = std::bit_cast<double>(exponent | 0x4330000000000000U) - (0x1.0p52 + 0x1.0p10);
  const std::uint64_t mantissa = bits - ((exponent - 1024U) << 52U);
  const double m = std::bit_cast<double>(mantissa);
  const double s = (m - 1.0) / (m + 1.0);
  const double z = s * s;
  double series = 1.0 / 23.0;
  series = series * z + 1.0 / 21.0;
  series = series * z + 1.0 / 19.0;
  series = series * z + 1.0 / 17.0;
  series = series * z + 1.0 / 15.0;
  series = series * z + 1.0 / 13.0;
  series = series * z + 1.0 / 11.0;
  series = series * z + 1.0 / 9.0;
  series = series * z + 1.0 / 7.0;
  series = series * z + 1.0 / 5.0;
  series = series * z + 1.0 / 3.0;
  const double log_m = 2.0 * s + 2.0 * s * (z * series);
  return -(e * 0x1.62e42fefa39efp-1 + log_m);
}

/// Cosine and sine of an angle, given as a fraction of a turn in [0, 1).
inline Pair cosine_and_sine(double turns) {
  // Adding a large number rounds to the nearest quarter; the last bits of the sum hold the integer.
  constexpr double shift = 0x1.8p52;
  const double shifted = 4.0 * turns + shift;
  const std::uint64_t quarter = std::bit_cast<std::uint64_t>(shifted);
  const double angle = (turns - 0.25 * (shifted - shift)) * 0x1.921fb54442d18p2;
  const double z = angle * angle;
  double sine = 1.0 / 355687428096000.0;
  sine = sine * z - 1.0 / 1307674368000.0;
  sine = sine * z + 1.0 / 6227020800.0;
  sine = sine * z - 1.0 / 39916800.0;
  sine = sine * z + 1.0 / 362880.0;
  sine = sine * z - 1.0 / 5040.0;
  sine = sine * z + 1.0 / 120.0;
  sine = sine * z - 1.0 / 6.0;
  sine = angle + angle * (sine * z);
  double cosine = 1.0 / 20922789888000.0;
  cosine = cosine * z - 1.0 / 87178291200.0;
  cosine = cosine * z + 1.0 / 479001600.0;
  cosine = cosine * z - 1.0 / 3628800.0;
  cosine = cosine * z + 1.0 / 40320.0;
  cosine = cosine * z - 1.0 / 720.0;
  cosine = cosine * z + 1.0 / 24.0;
  cosine = cosine * z - 0.5;
  cosine = cosine * z + 1.0;

  // Odd quarters swap the two. The signs are + + − −, the cosine's one quarter ahead of the sine's.
  const std::uint64_t swap = 0U - (quarter & 1U);
  const std::uint64_t c = std::bit_cast<std::uint64_t>(cosine);
  const std::uint64_t s = std::bit_cast<std::uint64_t>(sine);
  const std::uint64_t cosine_sign = ((quarter + 1U) & 2U) << 62U;
  const std::uint64_t sine_sign = (quarter & 2U) << 62U;
  return {std::bit_cast<double>(((c & ~swap) | (s & swap)) ^ cosine_sign),
          std::bit_cast<double>(((s & ~swap) | (c & swap)) ^ sine_sign)};
}

inline Pair box_muller(std::uint64_t radius_bits, std::uint64_t angle_bits) {
  const double radius = std::sqrt(2.0 * minus_log(2.0 - from_one_to_two(radius_bits)));
  const Pair direction = cosine_and_sine(from_one_to_two(angle_bits) - 1.0);
  return {radius * direction.first, radius * direction.second};
}

struct Bits {
  std::uint64_t radius;
  std::uint64_t angle;
};

/// Channels start at 1 in the counter. Zero is reserved for draws without a channel.
inline Bits bits_of(const NoiseKey& key, NoiseChannel channel, std::uint64_t block) {
  const std::uint64_t counter = ((static_cast<std::uint64_t>(channel) + 1U) << 48U) | block;
  const auto words = philox(key.seed, key.run, counter);
  return {std::uint64_t{words[0]} << 32U | words[1], std::uint64_t{words[2]} << 32U | words[3]};
}

}  // namespace

double standard_normal(const NoiseKey& key, NoiseChannel channel, std::uint64_t step) {
  const Bits bits = bits_of(key, channel, step / 2);
  const Pair pair = box_muller(bits.radius, bits.angle);
  return step % 2 == 0 ? pair.first : pair.second;
}

void fill_standard_normal(const NoiseKey& key, NoiseChannel channel, std::uint64_t first_step,
                          std::span<double> draws) {
  std::size_t done = 0;
  if (first_step % 2 == 1 && !draws.empty()) {
    draws[done++] = standard_normal(key, channel, first_step);
  }
  constexpr std::size_t batch = 64;
  std::array<std::uint64_t, batch> radius{};
  std::array<std::uint64_t, batch> angle{};
  while (draws.size() - done >= 2) {
    const std::size_t pairs = std::min(batch, (draws.size() - done) / 2);
    const std::uint64_t block = (first_step + done) / 2;
    for (std::size_t i = 0; i < pairs; ++i) {
      const Bits bits = bits_of(key, channel, block + i);
      radius[i] = bits.radius;
      angle[i] = bits.angle;
    }
    double* const out = draws.data() + done;
    for (std::size_t i = 0; i < pairs; ++i) {
      const Pair pair = box_muller(radius[i], angle[i]);
      out[2 * i] = pair.first;
      out[2 * i + 1] = pair.second;
    }
    done += 2 * pairs;
  }
  if (done < draws.size()) draws[done] = standard_normal(key, channel, first_step + done);
}

}  // namespace touchdown::noise
