#pragma once

#include <Eigen/Core>

#include "estimator/neural/network.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// m_t = [γ, ω, q, q̇, u_t−1] of the paper's neural measurement network, in this order:
/// acceleration without gravity (3) and angular velocity (3) in the IMU frame, six joint positions,
/// six joint velocities (left hip, knee, wheel, then right), the ground velocity commanded at the
/// previous step. The sine of a wheel's angle replaces the angle, which grows without bound and has
/// no meaning for a round wheel.
using NeuralInput = Eigen::Matrix<float, neural_input_count, 1>;

NeuralInput neural_input(const Signals& signals);

/// Converts the robot's rate to the network's. It takes one sample per control step. An input is
/// ready at the first sample and then after every `stride` samples. The training data had the
/// network's own step, so the acceleration is the mean over the stride: an acceleration that is a
/// velocity difference becomes exactly the difference over the longer step. The command is the one
/// after the previous input, all else is the last sample. Never throws or allocates.
///
/// Unusable samples do not shift the network's steps: an input that is due at one comes with the
/// next usable sample, and the input after it is due as if none had been missing. So a missing
/// sample leaves nothing behind but the network's memory of one late input.
class NeuralInputSampler {
 public:
  explicit NeuralInputSampler(int stride) noexcept : stride_(stride), steps_(stride - 1) {}

  void reset() noexcept;

  /// One control step with finite signals. Returns whether `input` is new.
  bool add(const Signals& signals) noexcept;
  /// One control step with unusable signals: only time passes.
  void skip() noexcept { count_step(); }

  [[nodiscard]] const NeuralInput& input() const noexcept { return input_; }

 private:
  void count_step() noexcept;

  int stride_;
  int steps_;            ///< since an input was last due
  bool is_due_ = false;  ///< an input, with the next usable sample
  int samples_ = 0;      ///< usable ones since the last input
  double command_ = 0.0;
  Eigen::Vector3d acceleration_sum_ = Eigen::Vector3d::Zero();
  NeuralInput input_ = NeuralInput::Zero();
};

}  // namespace touchdown
