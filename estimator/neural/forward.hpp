#pragma once

#include <memory>

#include <Eigen/Core>

#include "estimator/neural/network.hpp"

namespace touchdown {

/// Walks through time with a neural network: holds the recurrent state of `Lanes` independent
/// sequences side by side (a compile-time 1, or `Eigen::Dynamic` for as many as one likes, for
/// which the weights are read once per step). `step` does not throw; with one lane it allocates
/// nothing.
template <int Lanes>
class NeuralForward {
 public:
  using Columns = Eigen::Matrix<float, Eigen::Dynamic, Lanes>;

  /// `lanes` counts when `Lanes` is dynamic. Errors: `InputError` for no network or one that does
  /// not pass `check`.
  explicit NeuralForward(std::shared_ptr<const NeuralNetwork> network,
                         Eigen::Index lanes = Lanes == Eigen::Dynamic ? 0 : Lanes);

  /// Forget everything: the hidden state is zero, as at the beginning of a training episode.
  void reset() noexcept { hidden_.setZero(); }

  /// One step of every lane: raw inputs (neural_input_count × lanes) to outputs
  /// (neural_output_count × lanes).
  const Columns& step(const Columns& inputs) noexcept;

  [[nodiscard]] Eigen::Index lanes() const noexcept { return hidden_.cols(); }
  [[nodiscard]] const NeuralNetwork& network() const noexcept { return *network_; }
  [[nodiscard]] std::shared_ptr<const NeuralNetwork> shared_network() const noexcept {
    return network_;
  }

 private:
  std::shared_ptr<const NeuralNetwork> network_;
  Columns standardised_;
  Columns hidden_;
  Columns from_input_;
  Columns from_hidden_;
  Columns first_;
  Columns second_;
  Columns outputs_;
};

extern template class NeuralForward<1>;
extern template class NeuralForward<Eigen::Dynamic>;

}  // namespace touchdown
