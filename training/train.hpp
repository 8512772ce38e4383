#pragma once

#include "training/config.hpp"
#include "training/request.hpp"

namespace touchdown::training {

/// Trains a neural measurement network from nothing to a file: rolls out every iteration's data,
/// trains on it, and keeps the weights with the smallest validation loss. A training that was
/// stopped goes on from its last finished iteration when the same is asked for again.
/// Writes `models/nmn.npz` with its manifest `models/nmn.json`, `tables/training.csv` and
/// `figures/training.png` into the run directory. Errors: `Stopped`; as `roll_out`.
TrainingResult train(const TrainingConfig& config, const TrainingRequest& request);

}  // namespace touchdown::training
