#include "estimator/force/leg_geometry.hpp"

#include <cmath>

namespace touchdown {

FootJacobian foot_jacobian(const LegGeometry& geometry, const LegSignals& leg,
                           bool mirrored) noexcept {
  const double sign = mirrored ? -1.0 : 1.0;
  const double upper = sign * leg.hip.position;  // the links' angles from vertical
  const double lower = upper + sign * leg.knee.position;
  return {.upper_x = geometry.upper_length * std::cos(upper),
          .upper_z = geometry.upper_length * std::sin(upper),
          .lower_x = geometry.lower_length * std::cos(lower),
          .lower_z = geometry.lower_length * std::sin(lower)};
}

}  // namespace touchdown
