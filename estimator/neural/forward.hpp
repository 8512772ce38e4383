#pragma once

#include <memory>

#include <Eigen/Core>

#include "estimator/neural/network.hpp"

namespace touchdown {

/// The values of all layers at one step: a column of one sequence, or rows of many.
template <typename Values>
struct NeuralValues {
  Values standardised;  ///< inputs
  Values hidden;
  Values from_input;
  Values from_hidden;
  Values first;
  Values second;
  Values outputs;
};

/// One step from standardised inputs to outputs. `affine(layer, x, y)` computes y = weight · x +
/// bias by one of the layers of `net`. Values may have more rows than a layer has outputs.
template <typename Layers, typename Values, typename Affine>
void neural_step(const Layers& net, NeuralValues<Values>& v, const Affine& affine) noexcept {
  const Eigen::Index n = v.hidden.rows();
  // Gates as Cho et al. (2014) have them, with the reset gate behind the matrix:
  // h' = (1 − z) ∘ tanh(a_n + r ∘ b_n) + z ∘ h, where r = σ(a_r + b_r) and z = σ(a_z + b_z).
  affine(net.gru_input, v.standardised, v.from_input);
  affine(net.gru_hidden, v.hidden, v.from_hidden);
  auto gates = v.from_input.topRows(2 * n).array();
  gates = (gates + v.from_hidden.topRows(2 * n).array()).logistic();
  const auto reset = v.from_input.topRows(n).array();
  const auto update = v.from_input.middleRows(n, n).array();
  auto candidate = v.from_input.middleRows(2 * n, n).array();
  candidate = (candidate + reset * v.from_hidden.middleRows(2 * n, n).array()).tanh();
  v.hidden.array() = candidate + update * (v.hidden.array() - candidate);

  affine(net.first, v.hidden, v.first);
  v.first.array() = v.first.array().max(0.0F);
  affine(net.second, v.first, v.second);
  v.second.array() = v.second.array().max(0.0F);
  affine(net.heads, v.second, v.outputs);
}

/// Runs a neural network through time and holds its recurrent state. `step` neither throws nor
/// allocates.
class NeuralForward {
 public:
  using Column = Eigen::VectorXf;

  /// Errors: `InputError` for no network or one that `check` refuses.
  explicit NeuralForward(std::shared_ptr<const NeuralNetwork> network);

  /// Sets the hidden state to zero, as at the beginning of a training episode.
  void reset() noexcept { values_.hidden.setZero(); }

  /// One step: raw inputs (neural_input_count) to outputs (neural_output_count).
  const Column& step(const Column& inputs) noexcept;

  [[nodiscard]] const NeuralNetwork& network() const noexcept { return *network_; }
  [[nodiscard]] std::shared_ptr<const NeuralNetwork> shared_network() const noexcept {
    return network_;
  }

 private:
  std::shared_ptr<const NeuralNetwork> network_;
  NeuralValues<Column> values_;
};

}  // namespace touchdown
