#pragma once

#include <cstdint>
#include <tuple>

#include "estimator/evidence/curves.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

inline EvidenceModel random_curves(std::uint32_t seed) {
  Normal normal(seed);
  EvidenceModel model;
  const auto fill = [&](auto& numbers, double size) {
    for (float& x : numbers) x = static_cast<float>(size * normal());
  };
  for (EvidenceCurve& curve : model.curve) fill(curve, 0.3);
  model.bias = 0.2F;
  for (auto& ends : model.seen) ends = {-1.5F, 2.5F};
  return model;
}

/// With servo curves for steps with targets, and others for steps without.
inline EvidenceCurveSets random_curve_sets(std::uint32_t seed) {
  EvidenceModel with_targets = random_curves(seed);
  const EvidenceModel more = random_curves(seed + 1);
  with_targets.servo_curve.assign(more.curve.begin(),
                                  more.curve.begin() + std::tuple_size_v<ServoLoadInputs>);
  with_targets.servo_seen.assign(with_targets.servo_curve.size(), {-1.0F, 1.0F});
  return {with_targets, random_curves(seed + 2)};
}

}  // namespace touchdown::test
