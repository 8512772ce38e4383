#pragma once

#include <span>
#include <vector>

#include "estimator/neural/estimator.hpp"

namespace touchdown::experiments {

/// `NeuralEstimator` under many accelerometer noise levels side by side, for sweeps: one clean
/// recording and one noise realisation, one lane per level, so that the weights are read once for
/// all of them. (The network does not listen to torques.) Each lane's probabilities equal those of
/// a `NeuralEstimator` that is fed clean + sigma × draw, to 1e-5.
///
/// Meant for recordings: it has no guard against gaps or frozen sensors; a step with a value that
/// is not finite is skipped. `update` does not throw.
class BatchedNeuralNetwork {
 public:
  /// `sigmas`: standard deviations on each axis of the accelerometer (m/s²), one per lane.
  /// Errors: `InputError` as `NeuralEstimator`, and for no levels or bad ones.
  BatchedNeuralNetwork(std::shared_ptr<const NeuralNetwork> network, const NeuralEstimatorConfig& config,
              std::span<const double> sigmas);

  /// One step of the clean signals, with the standard normal draws that every lane scales.
  void update(const Signals& clean, const Eigen::Vector3d& acceleration_draw) noexcept;

  [[nodiscard]] std::size_t lanes() const noexcept { return p_contact_.size(); }
  /// P(S_t = C | m_0:t) of the robot, per lane in the order of the levels.
  [[nodiscard]] std::span<const double> p_contact() const noexcept { return p_contact_; }

 private:
  Eigen::RowVectorXf sigmas_;
  NeuralForward<Eigen::Dynamic> forward_;
  NeuralInputSampler clean_;
  NeuralInputSampler draws_;  ///< averages the draws as the other one averages accelerations
  NeuralForward<Eigen::Dynamic>::Columns inputs_;
  std::vector<double> p_contact_;
};

}  // namespace touchdown::experiments
