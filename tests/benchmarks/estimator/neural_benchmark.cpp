#include <cstdint>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/neural/estimator.hpp"
#include "experiments/batch/neural.hpp"
#include "time_updates.hpp"

namespace touchdown {
namespace {

/// A network of the paper's size, with small weights that are not denormal.
std::shared_ptr<const NeuralNetwork> network() {
  std::uint32_t state = 1;
  const auto fill = [&](auto& matrix, Eigen::Index rows, Eigen::Index columns) {
    matrix.resize(rows, columns);
    for (float& x : matrix.reshaped()) {
      state = state * 1664525U + 1013904223U;
      x = static_cast<float>(state >> 8U) / 1.6777216e8F - 0.05F;
    }
  };
  NeuralNetwork n;
  const auto layer = [&](DenseLayer& dense, Eigen::Index outputs, Eigen::Index inputs) {
    fill(dense.weight, outputs, inputs);
    fill(dense.bias, outputs, 1);
  };
  n.input_mean = Eigen::VectorXf::Zero(neural_input_count);
  n.input_scale = Eigen::VectorXf::Ones(neural_input_count);
  layer(n.gru_input, 384, neural_input_count);
  layer(n.gru_hidden, 384, 128);
  layer(n.first, 256, 128);
  layer(n.second, 128, 256);
  layer(n.heads, neural_output_count, 128);
  return std::make_shared<const NeuralNetwork>(std::move(n));
}

/// One step of the network.
void neural_step(benchmark::State& state) {
  NeuralForward forward(network());
  const NeuralForward::Column input = NeuralForward::Column::Constant(neural_input_count, 0.3F);
  for (auto _ : state) {
    benchmark::DoNotOptimize(forward.step(input).data());
  }
}
BENCHMARK(neural_step);

/// One `update` at 1 kHz. Every fifth one steps the network. Compare with the filter's.
void neural_update(benchmark::State& state) {
  NeuralEstimator estimator(network());
  bench::time_updates(state, estimator);
}
BENCHMARK(neural_update);

/// A batch of noise levels. The time per item is that of one level's update at 1 kHz.
void neural_batch_update(benchmark::State& state) {
  std::vector<experiments::BatchNoise> levels;
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    levels.push_back({.acceleration = 0.3 * static_cast<double>(i)});
  }
  experiments::BatchedNeuralNetwork batch(network(), {}, levels);
  const std::vector<Signals> stream = bench::signals(bench::stream_length);
  std::size_t i = 0;
  for (auto _ : state) {
    batch.update(stream[i], Eigen::Vector3d::Constant(0.1));
    benchmark::DoNotOptimize(batch.p_contact().data());
    i = (i + 1) % bench::stream_length;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(neural_batch_update)->Arg(1)->Arg(6)->Arg(36)->Arg(128);

}  // namespace
}  // namespace touchdown
