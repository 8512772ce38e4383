#pragma once

#include <cstdint>

#include "estimator/decision/network.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

/// A network with random weights.
inline DecisionModel random_model(std::uint32_t seed) {
  Normal normal(seed);
  DecisionModel model;
  const auto fill = [&](auto& numbers, double size) {
    for (float& x : numbers) x = static_cast<float>(size * normal());
  };
  fill(model.first_weight, 0.15);
  fill(model.first_bias, 0.1);
  fill(model.second_weight, 0.25);
  fill(model.second_bias, 0.1);
  fill(model.last_weight, 0.4);
  model.last_bias = 0.2F;
  return model;
}

}  // namespace touchdown::test
