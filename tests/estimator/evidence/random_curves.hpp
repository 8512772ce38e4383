#pragma once

#include <cstdint>

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

}  // namespace touchdown::test
