#include "estimator/neural/network.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "estimator/neural/forward.hpp"
#include "tests/estimator/neural/sample.hpp"

namespace touchdown {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Numbers = std::vector<double>;

/// The textbook algorithm, one number at a time, in double precision.
class PlainNetwork {
 public:
  explicit PlainNetwork(const NeuralNetwork& network)
      : net_(network), h_(static_cast<std::size_t>(network.hidden()), 0.0) {}

  Numbers step(const Numbers& raw) {
    Numbers x(raw.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      x[i] = (raw[i] - double{net_.input_mean[k]}) * double{net_.input_scale[k]};
    }
    const Numbers a = affine(net_.gru_input, x);
    const Numbers b = affine(net_.gru_hidden, h_);
    const std::size_t n = h_.size();
    for (std::size_t j = 0; j < n; ++j) {
      const double r = sigmoid(a[j] + b[j]);
      const double z = sigmoid(a[n + j] + b[n + j]);
      const double candidate = std::tanh(a[2 * n + j] + r * b[2 * n + j]);
      h_[j] = (1.0 - z) * candidate + z * h_[j];
    }
    return affine(net_.heads, rectified(affine(net_.second, rectified(affine(net_.first, h_)))));
  }

 private:
  static double sigmoid(double x) { return 1.0 / (1.0 + std::exp(-x)); }

  static Numbers rectified(Numbers x) {
    for (double& value : x) value = value > 0.0 ? value : 0.0;
    return x;
  }

  static Numbers affine(const DenseLayer& layer, const Numbers& x) {
    Numbers y;
    for (Eigen::Index i = 0; i < layer.weight.rows(); ++i) {
      double sum = double{layer.bias[i]};
      for (Eigen::Index j = 0; j < layer.weight.cols(); ++j) {
        sum += double{layer.weight(i, j)} * x[static_cast<std::size_t>(j)];
      }
      y.push_back(sum);
    }
    return y;
  }

  const NeuralNetwork& net_;
  Numbers h_;
};

Numbers random_input(test::Normal& normal) {
  Numbers input(neural_input_count);
  for (double& x : input) x = double{static_cast<float>(2.0 * normal())};
  return input;
}

TEST(NeuralForward, AgreesWithTheTextbookOverManySteps) {
  const NeuralNetwork network = test::random_network();
  NeuralForward forward(test::shared(network));
  PlainNetwork plain(network);
  test::Normal normal(7);
  for (int step = 0; step < 300; ++step) {
    const Numbers input = random_input(normal);
    NeuralForward::Column column(neural_input_count);
    for (int i = 0; i < neural_input_count; ++i) {
      column[i] = static_cast<float>(input[static_cast<std::size_t>(i)]);
    }
    const auto& output = forward.step(column);
    const Numbers expected = plain.step(input);
    for (int i = 0; i < neural_output_count; ++i) {
      ASSERT_NEAR(output[i], expected[static_cast<std::size_t>(i)], 1e-5) << step;
    }
  }
}

TEST(NeuralNetwork, AcceptsAnySizesThatFit) {
  EXPECT_NO_THROW(check(test::random_network()));
  EXPECT_NO_THROW(check(test::random_network(3, 5, 2)));
}

TEST(NeuralNetwork, NamesTheArrayThatDoesNotFit) {
  const auto complaint = [](const auto& spoil, const char* text) {
    NeuralNetwork network = test::random_network(4, 6, 5);
    spoil(network);
    EXPECT_THAT([&] { check(network); }, ThrowsMessage<InputError>(HasSubstr(text)));
  };
  complaint([](NeuralNetwork& n) { n = {}; }, "gru_hidden_weight: is empty");
  complaint([](NeuralNetwork& n) { n.input_mean.conservativeResize(18); },
            "input_mean: expected 19 numbers, found 18");
  complaint([](NeuralNetwork& n) { n.gru_input.weight.conservativeResize(11, 19); },
            "gru_input_weight: expected shape 12 × 19, found 11 × 19");
  complaint([](NeuralNetwork& n) { n.first.bias.conservativeResize(7); }, "first_bias");
  complaint([](NeuralNetwork& n) { n.heads.weight.conservativeResize(3, 5); },
            "heads_weight: expected shape 4 × 5");
  complaint([](NeuralNetwork& n) { n.second.weight(0, 0) = std::nanf(""); },
            "second_weight: expected finite");
  complaint([](NeuralNetwork& n) { n.heads.bias[0] = std::numeric_limits<float>::infinity(); },
            "heads_bias: expected finite");
  complaint([](NeuralNetwork& n) { n.period = 0.0; }, "period");
}

}  // namespace
}  // namespace touchdown
