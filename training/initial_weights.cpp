#include "training/initial_weights.hpp"

#include <cmath>

#include "core/random.hpp"

namespace touchdown::training {

namespace {

constexpr std::uint64_t weights_stream = 0x77656967687473;  // "weights"

/// Draws uniform weights, layer by layer, from one stream.
class UniformWeights {
 public:
  explicit UniformWeights(std::uint64_t seed) : seed_(seed) {}

  DenseLayer layer(Eigen::Index outputs, Eigen::Index inputs, Eigen::Index fan) {
    const double bound = 1.0 / std::sqrt(static_cast<double>(fan));
    DenseLayer dense{Eigen::MatrixXf(outputs, inputs), Eigen::VectorXf(outputs)};
    for (float& weight : dense.weight.reshaped()) weight = draw(bound);
    for (float& bias : dense.bias) bias = draw(bound);
    return dense;
  }

 private:
  float draw(double bound) {
    return static_cast<float>(bound * (2.0 * uniform01(seed_, weights_stream, drawn_++) - 1.0));
  }

  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
};

void standardise(NeuralNetwork& network, const std::vector<float>& inputs) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, neural_input_count, Eigen::RowMajor>;
  const Eigen::Map<const Rows> rows(inputs.data(),
                                    static_cast<Eigen::Index>(inputs.size()) / neural_input_count,
                                    neural_input_count);
  const Eigen::Matrix<double, 1, neural_input_count> mean = rows.cast<double>().colwise().mean();
  const Eigen::Matrix<double, 1, neural_input_count> deviation =
      (rows.cast<double>().rowwise() - mean).colwise().squaredNorm().cwiseSqrt() /
      std::sqrt(static_cast<double>(rows.rows()));
  constexpr double constant = 1e-6;
  network.input_mean = mean.transpose().cast<float>();
  network.input_scale = (deviation.array() > constant)
                            .select(deviation.array().inverse(), 1.0)
                            .transpose()
                            .matrix()
                            .cast<float>();
}

}  // namespace

NeuralNetwork initial_network(const NetworkSize& size, std::uint64_t seed, const EpisodeBatch& data,
                              double period) {
  NeuralNetwork network;
  network.period = period;
  standardise(network, data.input);
  UniformWeights weights(seed);
  const Eigen::Index hidden = size.hidden;
  network.gru_input = weights.layer(3 * hidden, neural_input_count, hidden);
  network.gru_hidden = weights.layer(3 * hidden, hidden, hidden);
  network.first = weights.layer(size.first, hidden, hidden);
  network.second = weights.layer(size.second, size.first, size.first);
  network.heads = weights.layer(neural_output_count, size.second, size.second);
  return network;
}

}  // namespace touchdown::training
