#pragma once

#include <cstdint>

#include "estimator/neural/network.hpp"
#include "training/config.hpp"
#include "training/rollout.hpp"

namespace touchdown::training {

/// A network to begin with: weights and biases uniform within ±1/√n as is usual, n being the hidden
/// size for the GRU and the number of inputs for the other layers. A function of the seed alone.
/// Inputs are standardised by the mean and standard deviation of `data`; inputs that do not vary by
/// more than rounding (joints that hold still) are only centred.
NeuralNetwork initial_network(const NetworkSize& size, std::uint64_t seed, const EpisodeBatch& data,
                              double period);

}  // namespace touchdown::training
