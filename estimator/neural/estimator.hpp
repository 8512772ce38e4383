#pragma once

#include <memory>

#include "estimator/contact_estimator.hpp"
#include "estimator/neural/forward.hpp"
#include "estimator/neural/input.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

struct NeuralEstimatorConfig {
  /// How often `update` is called (Hz). One step of the network lasts a whole number of samples;
  /// the belief holds in between.
  double sample_rate = 1000.0;
  /// Contact is decided at this probability or above.
  double threshold = 0.8;
  SignalGuardConfig guard = {};

  bool operator==(const NeuralEstimatorConfig&) const = default;
};

/// How many samples make one step of the network. Errors: `InputError` if it is not a whole number.
int neural_stride(double sample_rate, double period);

/// The paper's neural measurement network as a contact estimator. It tells one probability for the
/// robot, which both wheels and the robot's views get. Signals that are not finite are left out and
/// the belief relaxes towards the prior; after a gap the recurrent state starts anew.
class NeuralEstimator : public ContactEstimator {
 public:
  /// Errors: `InputError` for a network that does not pass `check` or a bad configuration.
  explicit NeuralEstimator(std::shared_ptr<const NeuralNetwork> network,
                           const NeuralEstimatorConfig& config = {});

  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;

  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  /// Of the IMU, in the base frame (m/s), at the network's last step; zero before the first.
  [[nodiscard]] const Eigen::Vector3d& body_velocity() const noexcept { return velocity_; }
  [[nodiscard]] const NeuralEstimatorConfig& config() const noexcept { return config_; }
  /// Shared with all who use the same one.
  [[nodiscard]] std::shared_ptr<const NeuralNetwork> network() const noexcept {
    return forward_.shared_network();
  }

 private:
  void step() noexcept;
  void apply_threshold(double p_contact) noexcept;

  NeuralEstimatorConfig config_;
  SignalGuard guard_;
  NeuralForward<1> forward_;
  NeuralInputSampler sampler_;
  NeuralForward<1>::Columns input_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Belief belief_;
};

}  // namespace touchdown
