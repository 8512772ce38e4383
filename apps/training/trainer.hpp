#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "apps/training/config/optimiser.hpp"
#include "estimator/neural/network.hpp"

namespace touchdown::training {

/// Labelled episodes of parallel environments, as inputs and targets of the network. The step is
/// the slowest index, then the environment.
struct EpisodeBatch {
  int steps = 0;
  int environments = 0;
  int sequence = 1;
  std::vector<float> input;     ///< steps × environments × neural_input_count, not standardised
  std::vector<float> contact;   ///< steps × environments: 1 in contact, 0 not
  std::vector<float> velocity;  ///< steps × environments × 3: of the IMU in the base frame (m/s)
  /// (steps / sequence) × environments: 0 where a sequence begins a new run, which resets the
  /// hidden state; 1 elsewhere.
  std::vector<float> keep;

  /// Total simulated time (s).
  double seconds(double period) const { return period * steps * environments; }
};

/// Mean losses of a network over a batch of episodes.
struct Loss {
  double contact = 0.0;   ///< cross-entropy of the contact probability (nat)
  double velocity = 0.0;  ///< squared error, mean over the three axes (m²/s²)
  double total = 0.0;     ///< contact + velocity_weight × velocity
  /// Contact accuracy: share of steps in which P(S = C) ≥ 0.5 equals the label.
  double accuracy = 0.0;
};

/// Sets the number of threads for training and evaluation. Required, because libtorch uses only
/// half of the cores by default: it takes the others for hyperthreads.
void set_training_threads(int threads);

/// Called between sequences, from several threads at once. It stops the work by an exception.
using StopIfAsked = std::function<void()>;

/// Trains a neural measurement network by truncated backpropagation through time: the recurrent
/// state is carried through an episode, gradients through one sequence of it. There is one
/// optimiser step per sequence of all environments. The same seed, data and `parts` give the same
/// bits for any number of threads.
class Trainer {
 public:
  Trainer(const NeuralNetwork& network, const OptimiserConfig& config);
  ~Trainer();
  Trainer(const Trainer&) = delete;
  Trainer& operator=(const Trainer&) = delete;

  /// Trains on all episodes once. Returns the losses during this epoch.
  Loss train_epoch(const EpisodeBatch& batch, const StopIfAsked& stop_if_asked = {});
  Loss evaluate(const EpisodeBatch& batch, const StopIfAsked& stop_if_asked = {}) const;
  /// Outputs of the network: steps × environments × neural_output_count.
  std::vector<float> outputs(const EpisodeBatch& batch) const;

  NeuralNetwork network() const;

  /// Saves the state of the training, to the bit: weights and the optimiser's moments.
  void save(const std::filesystem::path& path) const;
  /// Restores a saved state. Errors: `InputError` for a file that is no such checkpoint.
  void load(const std::filesystem::path& path);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace touchdown::training
