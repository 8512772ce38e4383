#pragma once

#include <Eigen/Core>

namespace touchdown {

/// The number of inputs of the neural measurement network per step; see `NeuralInput`.
inline constexpr int neural_input_count = 19;
/// The number of its outputs: the logit of P(S_t = C | m_t), then the body's linear velocity (m/s).
inline constexpr int neural_output_count = 4;

/// y = weight · x + bias.
struct DenseLayer {
  Eigen::MatrixXf weight;  ///< outputs × inputs
  Eigen::VectorXf bias;    ///< outputs
};

/// The paper's neural measurement network (NMN, Section V): one GRU layer, two rectified layers,
/// two heads. It holds only numbers, in their training precision. With the paper's sizes (128
/// hidden, 256 × 128) there are 123,652 of them.
struct NeuralNetwork {
  double period = 0.005;        ///< of one of its steps (s)
  Eigen::VectorXf input_mean;   ///< of the training data
  Eigen::VectorXf input_scale;  ///< standardised input = (input − mean) ∘ scale
  DenseLayer gru_input;         ///< 3·hidden × inputs: reset gate, update gate, candidate
  DenseLayer gru_hidden;        ///< 3·hidden × hidden, in the same order
  DenseLayer first;             ///< of the perceptron, behind a rectifier
  DenseLayer second;            ///< the same
  DenseLayer heads;             ///< neural_output_count × outputs of `second`

  [[nodiscard]] Eigen::Index hidden() const { return gru_hidden.weight.cols(); }
};

/// Errors: `InputError` that names the array, for shapes that do not fit each other or the inputs
/// and outputs above, and for weights that are not finite.
void check(const NeuralNetwork& network);

}  // namespace touchdown
