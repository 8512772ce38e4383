#pragma once

#include <memory>

#include "estimator/contact_estimator.hpp"
#include "estimator/members.hpp"
#include "estimator/neural/forward.hpp"
#include "estimator/neural/input.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

struct NeuralEstimatorConfig {
  /// How often `update` is called (Hz). One step of the network lasts a whole number of samples,
  /// and the belief stays in between.
  double sample_rate = 1000.0;
  /// The estimator decides for contact at this probability or above.
  double threshold = 0.8;
  SignalGuardConfig guard = {};

  bool operator==(const NeuralEstimatorConfig&) const = default;
};

void members(auto& visit, MembersOf<NeuralEstimatorConfig> auto& config) {
  visit("threshold", config.threshold, Range::share);
  members(visit, config.guard);
}

/// The number of samples per step of the network. Errors: `InputError` if it is not a whole number.
int neural_stride(double sample_rate, double period);

/// The paper's neural measurement network as a contact estimator. It estimates one probability for
/// the robot, which serves for each wheel, for any wheel and for both. It skips signals that are
/// not finite, and the belief then relaxes towards the prior. The network's steps keep their times
/// (`NeuralInputSampler`). After a gap the recurrent state restarts, and the first record after the
/// gap is the first input.
class NeuralEstimator : public ContactEstimator {
 public:
  /// Errors: `InputError` for a network that `check` refuses and for an invalid configuration.
  explicit NeuralEstimator(std::shared_ptr<const NeuralNetwork> network,
                           const NeuralEstimatorConfig& config = {});

  void reset() noexcept override;

  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  /// Velocity of the IMU in the base frame (m/s) at the network's last step; zero before the first.
  [[nodiscard]] const Eigen::Vector3d& body_velocity() const noexcept { return velocity_; }
  [[nodiscard]] const NeuralEstimatorConfig& config() const noexcept { return config_; }
  /// The network, shared with all estimators that use it.
  [[nodiscard]] std::shared_ptr<const NeuralNetwork> network() const noexcept {
    return forward_.shared_network();
  }

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  void step() noexcept;
  void apply_threshold(double p_contact) noexcept;

  NeuralEstimatorConfig config_;
  SignalGuard guard_;
  NeuralForward forward_;
  NeuralInputSampler sampler_;
  NeuralForward::Column input_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Belief belief_;
};

}  // namespace touchdown
