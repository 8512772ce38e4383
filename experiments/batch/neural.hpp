#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "estimator/neural/estimator.hpp"
#include "estimator/neural/forward.hpp"
#include "experiments/batch/noise_level.hpp"

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
  void reset() noexcept { values_.hidden.setZero(); }

  /// One step of every sequence: raw inputs (neural_input_count × batch) to outputs
  /// (neural_output_count × batch).
  const Columns& step(const Columns& inputs) noexcept;

  [[nodiscard]] const NeuralNetwork& network() const noexcept { return *network_; }

 private:
  /// Values of all sequences side by side, padded with zeros to whole vectors.
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// A layer with its weights in the order in which `apply` reads them.
  struct PackedLayer {
    explicit PackedLayer(const DenseLayer& layer);

    Eigen::Index depth;          ///< inputs
    std::vector<float> weights;  ///< by block of outputs, then input
    std::vector<float> bias;     ///< padded to whole blocks
  };
  /// The layers in the order in which a step applies them.
  struct PackedLayers {
    explicit PackedLayers(const NeuralNetwork& network)
        : gru_input(network.gru_input),
          gru_hidden(network.gru_hidden),
          first(network.first),
          second(network.second),
          heads(network.heads) {}

    PackedLayer gru_input;
    PackedLayer gru_hidden;
    PackedLayer first;
    PackedLayer second;
    PackedLayer heads;
  };

  std::shared_ptr<const NeuralNetwork> network_;
  PackedLayers layers_;
  NeuralValues<Rows> values_;
  Columns outputs_;
};

/// `NeuralEstimator` for a batch of accelerometer noise levels, for sweeps: one clean recording,
/// one noise realisation, one element per level. The weights are read once for the whole batch.
/// (The network does not use torques.) The probabilities of each element equal those of a
/// `NeuralEstimator` with the input clean + sigma × draw, to 1e-5.
///
/// It is meant for recordings: it has no guard against gaps or frozen sensors, and skips a step
/// with a value that is not finite. `update` does not throw.
class BatchedNeuralNetwork {
 public:
  /// Errors: `InputError` as `NeuralEstimator`, and for no levels or bad ones.
  BatchedNeuralNetwork(std::shared_ptr<const NeuralNetwork> network,
                       const NeuralEstimatorConfig& config, std::span<const BatchNoise> levels);

  /// Processes one step of clean signals. Each element scales the standard normal draws by its
  /// sigma.
  void update(const Signals& clean, const Eigen::Vector3d& acceleration_draw) noexcept;

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
