#pragma once

#include <memory>

#include <Eigen/Core>

#include "estimator/neural/network.hpp"

namespace touchdown {

/// Runs a neural network through time. It holds the recurrent state of a batch of independent
/// sequences, each a column. `Batch` is their number at compile time, 1 or `Eigen::Dynamic`; one
/// step reads the weights once for the whole batch. `step` does not throw, and allocates nothing
/// for a batch of 1.
template <int Batch>
class NeuralForward {
 public:
  using Columns = Eigen::Matrix<float, Eigen::Dynamic, Batch>;

  /// `batch` is the number of sequences if `Batch` is dynamic. Errors: `InputError` for no network
  /// or one that `check` refuses.
  explicit NeuralForward(std::shared_ptr<const NeuralNetwork> network,
                         Eigen::Index batch = Batch == Eigen::Dynamic ? 0 : Batch);

  /// Sets the hidden state to zero, as at the beginning of a training episode.
  void reset() noexcept { hidden_.setZero(); }

  /// One step of every sequence: raw inputs (neural_input_count × batch) to outputs
  /// (neural_output_count × batch).
  const Columns& step(const Columns& inputs) noexcept;

  [[nodiscard]] Eigen::Index batch() const noexcept { return hidden_.cols(); }
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
