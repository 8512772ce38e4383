#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "estimator/neural/network.hpp"

namespace touchdown::training {

/// Labelled episodes of many environments side by side, ready for the network: step by step, then
/// environment by environment.
struct EpisodeBatch {
  int steps = 0;
  int environments = 0;
  int sequence = 1;
  std::vector<float> input;     ///< steps × environments × neural_input_count, not standardised
  std::vector<float> contact;   ///< steps × environments: 1 in contact, 0 not
  std::vector<float> velocity;  ///< steps × environments × 3: of the IMU in the base frame (m/s)
  /// (steps / sequence) × environments: 0 where a sequence begins a run, so that what the network
  /// remembers of the run before is void; 1 elsewhere.
  std::vector<float> keep;

  /// What the robot lived through in it (s).
  double seconds(double period) const { return period * steps * environments; }
};

/// How a network learns from episodes, and when it has learned enough.
struct OptimiserConfig {
  int iterations = 25;          ///< at most, each with data of its own
  int epochs = 32;              ///< over an iteration's data
  double learning_rate = 5e-4;  ///< of Adam
  /// Of the velocity's squared error (s²/m²), beside the cross-entropy.
  double velocity_weight = 1.0;
  int patience = 5;                ///< iterations without a better validation loss before stopping
  int validation_episodes = 1000;  ///< never trained on
  /// Parts of a batch whose gradients are computed side by side, then added in order. Threads work
  /// on parts, so that their number changes no bit of the result.
  int parts = 4;
};

/// Mean losses of a network over a batch of episodes.
struct Loss {
  double contact = 0.0;   ///< cross-entropy of the contact probability (nat)
  double velocity = 0.0;  ///< squared error, mean over the three axes (m²/s²)
  double total = 0.0;     ///< contact + velocity_weight × velocity
  /// Share of steps whose contact is told right by P(S = C) ≥ 0.5.
  double accuracy = 0.0;
};

/// How many threads networks are trained and evaluated with from now on. Has to be said: libtorch
/// takes half of the cores for siblings of the other half.
void set_training_threads(int threads);

/// Trains a neural measurement network by truncated backpropagation through time: the recurrent
/// state is carried through an episode, gradients through one sequence of it. One optimiser step
/// per sequence of all environments. The same seed, data and `parts` give the same bits, whatever
/// the number of threads.
class Trainer {
 public:
  /// Starts from `network`.
  Trainer(const NeuralNetwork& network, const OptimiserConfig& config);
  ~Trainer();
  Trainer(const Trainer&) = delete;
  Trainer& operator=(const Trainer&) = delete;

  /// Goes once through the episodes. Returns the losses met on the way.
  Loss train_epoch(const EpisodeBatch& batch);
  Loss evaluate(const EpisodeBatch& batch) const;
  /// steps × environments × neural_output_count.
  std::vector<float> outputs(const EpisodeBatch& batch) const;

  NeuralNetwork network() const;

  /// All that training goes on from, to the bit: weights and the optimiser's moments.
  void save(const std::filesystem::path& path) const;
  /// Errors: `InputError` for a file that is not a checkpoint of such a network.
  void load(const std::filesystem::path& path);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace touchdown::training
