#pragma once

namespace touchdown::training {

/// Settings of the optimiser, and when it stops.
struct OptimiserConfig {
  int iterations = 25;          ///< at most, each with new data
  int epochs = 32;              ///< over an iteration's data
  double learning_rate = 5e-4;  ///< of Adam
  /// Weight of the squared velocity error relative to the cross-entropy (s²/m²).
  double velocity_weight = 1.0;
  int patience = 5;                ///< iterations without a better validation loss before stopping
  int validation_episodes = 1000;  ///< never trained on
  /// A batch is split into this many parts. Their gradients are computed in parallel, then added in
  /// order, so the number of threads changes no bit of the result.
  int parts = 4;
};

}  // namespace touchdown::training
