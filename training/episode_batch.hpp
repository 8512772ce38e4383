#pragma once

#include <vector>

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

}  // namespace touchdown::training
