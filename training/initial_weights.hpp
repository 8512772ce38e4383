#pragma once

#include <cstdint>

#include "estimator/neural/network.hpp"
#include "training/config/training.hpp"
#include "training/rollout.hpp"

namespace touchdown::training {

/// The initial network. Weights and biases are uniform within ±1/√n, where n is the hidden size for
/// the GRU and the number of inputs for the other layers. They depend on the seed only. Inputs are
/// standardised by the mean and standard deviation of `data`. Inputs that are constant up to
/// rounding (joints that do not move) are only centred.
NeuralNetwork initial_network(const NetworkSize& size, std::uint64_t seed, const EpisodeBatch& data,
                              double period);

}  // namespace touchdown::training
