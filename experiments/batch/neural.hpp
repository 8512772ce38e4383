#pragma once

#include <span>
#include <vector>

#include "estimator/neural/estimator.hpp"
#include "experiments/batch/neural_forward.hpp"

namespace touchdown::experiments {

/// `NeuralEstimator` for a batch of accelerometer noise levels, for sweeps: one clean recording,
/// one noise realisation, one element per level. The weights are read once for the whole batch.
/// (The network does not use torques.) The probabilities of each element equal those of a
/// `NeuralEstimator` with the input clean + sigma × draw, to 1e-5.
///
/// It is meant for recordings: it has no guard against gaps or frozen sensors, and skips a step
/// with a value that is not finite. `update` does not throw.
class BatchedNeuralNetwork {
 public:
  /// `sigmas`: standard deviation on each axis of the accelerometer (m/s²), one per noise level.
  /// Errors: `InputError` as `NeuralEstimator`, and for no levels or bad ones.
  BatchedNeuralNetwork(std::shared_ptr<const NeuralNetwork> network,
                       const NeuralEstimatorConfig& config, std::span<const double> sigmas);

  /// Processes one step of clean signals. Each element scales the standard normal draws by its
  /// sigma.
  void update(const Signals& clean, const Eigen::Vector3d& acceleration_draw) noexcept;

  /// The number of noise levels.
  [[nodiscard]] std::size_t size() const noexcept { return p_contact_.size(); }
  /// P(S_t = C | m_0:t) of the robot, per noise level.
  [[nodiscard]] std::span<const double> p_contact() const noexcept { return p_contact_; }

 private:
  Eigen::RowVectorXf sigmas_;
  BatchedNeuralForward forward_;
  NeuralInputSampler clean_;
  NeuralInputSampler draws_;  ///< averages the draws as `clean_` averages accelerations
  BatchedNeuralForward::Columns inputs_;
  std::vector<double> p_contact_;
};

}  // namespace touchdown::experiments
