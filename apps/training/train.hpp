#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/training/config/training.hpp"
#include "apps/training/history.hpp"
#include "apps/training/rollout.hpp"
#include "core/machine.hpp"
#include "estimator/neural/network.hpp"

namespace touchdown::training {

/// How a training is run. None of it changes the weights.
struct TrainingRequest {
  std::filesystem::path out;                ///< run directory; empty: runs/<name>/<id>
  std::filesystem::path network;            ///< also write the chosen weights here; may be empty
  std::string command;                      ///< command line, for the manifest
  int threads = 0;                          ///< 0: one per core
  const std::atomic<bool>* stop = nullptr;  ///< becomes true when the user wants to stop

  bool wants_stop() const { return stop != nullptr && *stop; }
  int thread_count() const {
    if (threads > 0) return threads;
    return machine_share().processors;
  }
};

struct TrainingResult {
  std::filesystem::path directory;
  std::filesystem::path network;  ///< the weights of the chosen iteration
  std::filesystem::path figure;   ///< empty if it could not be drawn
  TrainingHistory history;
  std::size_t chosen = 0;  ///< index into the history
};

/// Trains a neural measurement network: every iteration simulates new data and trains on it. The
/// weights with the smallest validation loss are kept. A stopped training resumes after its last
/// finished iteration when it is requested again. Writes `models/nmn.npz` with its manifest
/// `models/nmn.json`, `tables/training.csv` and `figures/training.png` into the run directory.
/// Errors: `Stopped`; as `roll_out`.
TrainingResult train(const TrainingConfig& config, const TrainingRequest& request);

/// The initial network. Weights and biases are uniform within ±1/√n, where n is the hidden size for
/// the GRU and the number of inputs for the other layers. They depend on the seed only. Inputs are
/// standardised by the mean and standard deviation of `data`. Inputs that are constant up to
/// rounding (joints that do not move) are only centred.
NeuralNetwork initial_network(const NetworkSize& size, std::uint64_t seed, const EpisodeBatch& data,
                              double period);

/// The BLAS library that the dynamic linker gave to libtorch, links resolved; empty if unknown.
std::string blas_in_use();

/// A warning with advice about a BLAS library; empty for a good one. libtorch uses it for matrix
/// products, which dominate training time: Debian's reference BLAS is about twenty times slower
/// than OpenBLAS.
std::string blas_warning(const std::string& library);

}  // namespace touchdown::training
