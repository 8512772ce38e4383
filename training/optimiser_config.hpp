#pragma once

namespace touchdown {

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

}  // namespace touchdown
