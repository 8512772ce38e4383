#pragma once

#include <cmath>
#include <random>

#include "apps/training/rollout.hpp"
#include "estimator/neural/network.hpp"

namespace touchdown::training::test {

/// Episodes with labels that follow from the inputs by a rule with memory: contact is whether the
/// first input was positive three steps ago, velocity is a mix of the present inputs.
inline EpisodeBatch toy_episodes(int environments, int steps = 40, std::uint32_t seed = 1) {
  constexpr int delay = 3;
  std::mt19937 engine(seed);
  const auto draw = [&] {
    return static_cast<float>(static_cast<double>(engine()) / 4294967296.0 * 2.0 - 1.0);
  };
  EpisodeBatch batch;
  batch.steps = steps;
  batch.environments = environments;
  batch.sequence = 10;
  const auto n = static_cast<std::size_t>(environments);
  const auto rows = static_cast<std::size_t>(steps) * n;
  batch.input.resize(rows * neural_input_count);
  for (float& x : batch.input) x = draw();
  batch.contact.resize(rows);
  batch.velocity.resize(rows * 3);
  batch.keep.assign(rows / 10, 1.0F);
  for (std::size_t row = 0; row < rows; ++row) {
    const bool known = row >= delay * n;
    batch.contact[row] =
        known && batch.input[(row - delay * n) * neural_input_count] > 0.0F ? 1.0F : 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      batch.velocity[row * 3 + axis] = 0.5F * batch.input[row * neural_input_count + axis];
    }
  }
  for (std::size_t i = 0; i < n; ++i) batch.keep[i] = 0.0F;
  return batch;
}

}  // namespace touchdown::training::test
