#include "recordings/models/neural_network.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "recordings/models/npz.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::recordings {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// Random bits that are finite floats: denormals, tiny and huge numbers among them.
NeuralNetwork odd_network() {
  std::mt19937 engine(1);
  const auto fill = [&](auto& matrix, Eigen::Index rows, Eigen::Index columns) {
    matrix.resize(rows, columns);
    for (float& x : matrix.reshaped()) {
      do {
        const auto bits = static_cast<std::uint32_t>(engine());
        std::memcpy(&x, &bits, sizeof x);
      } while (!std::isfinite(x));
    }
  };
  NeuralNetwork n;
  fill(n.input_mean, neural_input_count, 1);
  fill(n.input_scale, neural_input_count, 1);
  const auto layer = [&](DenseLayer& dense, Eigen::Index outputs, Eigen::Index inputs) {
    fill(dense.weight, outputs, inputs);
    fill(dense.bias, outputs, 1);
  };
  layer(n.gru_input, 12, neural_input_count);
  layer(n.gru_hidden, 12, 4);
  layer(n.first, 6, 4);
  layer(n.second, 5, 6);
  layer(n.heads, neural_output_count, 5);
  return n;
}

class NeuralNetworkFile : public testing::Test {
 protected:
  void expect_complaint(const std::string& text) const {
    EXPECT_THAT([&] { read_neural_network(path_); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr(path_.string()), HasSubstr(text), Not(HasSubstr("\n")))));
  }

  const ScratchFolder scratch_;
  const std::filesystem::path path_ = scratch_ / "network.npz";
};

TEST_F(NeuralNetworkFile, KeepsEveryBit) {
  const NeuralNetwork written = odd_network();
  write_neural_network(written, path_);
  const NeuralNetwork read = read_neural_network(path_);
  const auto same_bits = [](const auto& a, const auto& b) {
    return a.size() == b.size() && a.rows() == b.rows() &&
           std::memcmp(a.data(), b.data(), sizeof(float) * static_cast<std::size_t>(a.size())) == 0;
  };
  const auto same = [&](const DenseLayer& a, const DenseLayer& b) {
    return same_bits(a.weight, b.weight) && same_bits(a.bias, b.bias);
  };
  EXPECT_EQ(read.period, written.period);
  EXPECT_TRUE(same_bits(read.input_mean, written.input_mean));
  EXPECT_TRUE(same_bits(read.input_scale, written.input_scale));
  EXPECT_TRUE(same(read.gru_input, written.gru_input));
  EXPECT_TRUE(same(read.gru_hidden, written.gru_hidden));
  EXPECT_TRUE(same(read.first, written.first));
  EXPECT_TRUE(same(read.second, written.second));
  EXPECT_TRUE(same(read.heads, written.heads));
}

TEST_F(NeuralNetworkFile, ComplainsOnceAboutFilesThatAreNone) {
  expect_complaint("no such file");
  std::ofstream(path_) << "nonsense";
  expect_complaint("");
  write_npz({{"wheel_torque", {{2}, {1.0, 2.0}}}, {"period", {{1}, {0.005}}}}, path_);
  expect_complaint("missing input_mean, input_scale, gru_input_weight");
}

TEST_F(NeuralNetworkFile, ComplainsOnceWhereverTheFileIsCutOffOrSpoilt) {
  write_neural_network(odd_network(), path_);
  const std::string good = read_file(path_);
  for (const double part : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    std::ofstream(path_, std::ios::binary)
        << good.substr(0, static_cast<std::size_t>(part * static_cast<double>(good.size())));
    expect_complaint("");
  }
  std::string spoilt = good;
  spoilt[200] = static_cast<char>(spoilt[200] ^ 0x10);  // within the first array
  std::ofstream(path_, std::ios::binary) << spoilt;
  expect_complaint("");
}

TEST_F(NeuralNetworkFile, ComplainsAboutShapesThatDoNotFit) {
  NeuralNetwork network = odd_network();
  network.second.weight.conservativeResize(5, 7);
  write_neural_network(network, path_);
  expect_complaint("second_weight: expected shape 5 × 6");
  write_neural_network(odd_network(), path_);
  NpzArrays arrays = read_npz(path_);
  arrays["input_mean"] = {{19, 1}, std::vector<double>(19, 0.0)};
  write_npz(arrays, path_);
  expect_complaint("input_mean: expected 1 axes, found 2");
  arrays["input_mean"] = {{19}, std::vector<double>(19, std::nan(""))};
  write_npz(arrays, path_);
  expect_complaint("input_mean: expected finite numbers");
}

}  // namespace
}  // namespace touchdown::recordings
