#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "estimator/neural/network.hpp"

namespace touchdown::experiments {

/// `NeuralForward` for a batch of independent sequences, each a column. One step reads the weights
/// once for the whole batch. Outputs equal those of a `NeuralForward` per column, to 1e-5. `step`
/// neither throws nor allocates.
class BatchedNeuralForward {
 public:
  using Columns = Eigen::MatrixXf;

  /// Errors: `InputError` for no network, one that `check` refuses, and an empty batch.
  BatchedNeuralForward(std::shared_ptr<const NeuralNetwork> network, Eigen::Index batch);

  /// Sets the hidden states to zero.
  void reset() noexcept { hidden_.setZero(); }

  /// One step of every sequence: raw inputs (neural_input_count × batch) to outputs
  /// (neural_output_count × batch).
  const Columns& step(const Columns& inputs) noexcept;

  [[nodiscard]] const NeuralNetwork& network() const noexcept { return *network_; }

 private:
  /// Values of all sequences side by side, padded with zeros to whole vectors.
  using Rows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// A layer with its weights in the order in which `apply` reads them.
  struct PackedLayer {
    explicit PackedLayer(const DenseLayer& layer);

    Eigen::Index depth;          ///< inputs
    std::vector<float> weights;  ///< by block of outputs, then input
    std::vector<float> bias;     ///< padded to whole blocks
  };
  Rows rows_for(const PackedLayer& layer) const;
  static void apply(const PackedLayer& layer, const Rows& x, Rows& y) noexcept;

  std::shared_ptr<const NeuralNetwork> network_;
  PackedLayer gru_input_;
  PackedLayer gru_hidden_;
  PackedLayer first_layer_;
  PackedLayer second_layer_;
  PackedLayer heads_;
  Eigen::Index batch_;
  Eigen::Index width_;  ///< of the batch with its padding
  Rows standardised_;
  Rows hidden_;
  Rows from_input_;
  Rows from_hidden_;
  Rows first_;
  Rows second_;
  Rows last_;
  Columns outputs_;
};

}  // namespace touchdown::experiments
