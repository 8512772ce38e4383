#include "estimator/force/leg_geometry.hpp"

#include <algorithm>
#include <cstddef>

#include "estimator/numerics/sine.hpp"

namespace touchdown {

namespace {

/// Sines and cosines of the links' angles from vertical, side by side.
template <std::size_t links>
std::array<SineCosine, links> sines_and_cosines(const std::array<double, links>& angle) noexcept {
  constexpr double largest = 1e5;  // rad, the range of `sine_and_cosine`
  std::array<double, links> x;
  for (std::size_t i = 0; i < links; ++i) x[i] = std::clamp(angle[i], -largest, largest);
  std::array<double, links> sine;
  std::array<double, links> cosine;
  for (std::size_t i = 0; i < links; ++i) {
    const SineCosine both = sine_and_cosine(x[i]);
    sine[i] = both.sine;
    cosine[i] = both.cosine;
  }
  std::array<SineCosine, links> all;
  for (std::size_t i = 0; i < links; ++i) all[i] = {sine[i], cosine[i]};
  return all;
}

FootJacobian jacobian_of(const LegGeometry& geometry, SineCosine upper, SineCosine lower) noexcept {
  return {.upper_x = geometry.upper_length * upper.cosine,
          .upper_z = geometry.upper_length * upper.sine,
          .lower_x = geometry.lower_length * lower.cosine,
          .lower_z = geometry.lower_length * lower.sine};
}

}  // namespace

std::array<FootJacobian, 2> foot_jacobians(const LegGeometry& geometry,
                                           const std::array<LegSignals, 2>& legs) noexcept {
  const double left = legs[0].hip.position;
  const double right = -legs[1].hip.position;
  const auto links = sines_and_cosines<4>(
      {left, left + legs[0].knee.position, right, right - legs[1].knee.position});
  return {jacobian_of(geometry, links[0], links[1]), jacobian_of(geometry, links[2], links[3])};
}

FootJacobian foot_jacobian(const LegGeometry& geometry, const LegSignals& leg,
                           bool mirrored) noexcept {
  const double sign = mirrored ? -1.0 : 1.0;
  const double hip = sign * leg.hip.position;
  const auto links = sines_and_cosines<2>({hip, hip + sign * leg.knee.position});
  return jacobian_of(geometry, links[0], links[1]);
}

}  // namespace touchdown
