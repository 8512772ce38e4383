#include "experiments/batch/neural_forward.hpp"

#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "experiments/batch/wide_vectors.hpp"

namespace touchdown::experiments {
namespace {

/// Outputs that are computed together: their sums fill the registers, and each is a chain of its
/// own, so that no multiplication waits for another.
constexpr int outputs_in_block = 12;
constexpr Eigen::Index narrow_lanes = 8;
constexpr Eigen::Index wide_lanes = 16;

std::shared_ptr<const NeuralNetwork> checked(std::shared_ptr<const NeuralNetwork> network,
                                             Eigen::Index batch) {
  if (!network) throw InputError("neural batch: needs a network");
  if (batch < 1) throw InputError("neural batch: expected at least one sequence");
  check(*network);
  return network;
}

/// One block of outputs for some neighbouring columns: y = bias + Σ_k w_k x_k, in the order of k.
template <typename Lanes>
[[gnu::always_inline]] inline void block_of_columns(const float* weights, const float* bias,
                                                    Eigen::Index depth, const float* x, float* y,
                                                    Eigen::Index width) noexcept {
  Lanes sum[outputs_in_block] = {};
  for (Eigen::Index k = 0; k < depth; ++k) {
    Lanes input;
    std::memcpy(&input, x + k * width, sizeof input);
#pragma GCC unroll 12
    for (int output = 0; output < outputs_in_block; ++output) {
      sum[output] += weights[k * outputs_in_block + output] * input;
    }
  }
#pragma GCC unroll 12
  for (int output = 0; output < outputs_in_block; ++output) {
    const Lanes value = sum[output] + bias[output];
    std::memcpy(y + output * width, &value, sizeof value);
  }
}

struct Product {
  const float* weights;
  const float* bias;
  Eigen::Index blocks;
  Eigen::Index depth;
  const float* x;  ///< depth × width
  float* y;        ///< outputs × width
  Eigen::Index width;
};

using NarrowVector [[gnu::vector_size(4 * narrow_lanes)]] = float;

/// All blocks of a product, `Lanes` columns at a time, and the rest in narrow vectors.
template <typename Lanes>
[[gnu::always_inline]] inline void multiply_by(const Product& p) noexcept {
  constexpr auto columns_at_once = static_cast<Eigen::Index>(sizeof(Lanes) / sizeof(float));
  for (Eigen::Index block = 0; block < p.blocks; ++block) {
    const float* const weights = p.weights + block * outputs_in_block * p.depth;
    const float* const bias = p.bias + block * outputs_in_block;
    float* const y = p.y + block * outputs_in_block * p.width;
    Eigen::Index column = 0;
    for (; column + columns_at_once <= p.width; column += columns_at_once) {
      block_of_columns<Lanes>(weights, bias, p.depth, p.x + column, y + column, p.width);
    }
    for (; column < p.width; column += narrow_lanes) {
      block_of_columns<NarrowVector>(weights, bias, p.depth, p.x + column, y + column, p.width);
    }
  }
}

#ifdef TOUCHDOWN_HAS_WIDE_VECTORS
using WideVector [[gnu::vector_size(4 * wide_lanes)]] = float;

[[gnu::target("arch=x86-64-v4")]] void multiply_wide(const Product& product) noexcept {
  multiply_by<WideVector>(product);
}
#endif

void multiply(const Product& product) noexcept {
#ifdef TOUCHDOWN_HAS_WIDE_VECTORS
  if (__builtin_cpu_supports("x86-64-v4")) return multiply_wide(product);
#endif
  multiply_by<NarrowVector>(product);
}

}  // namespace

BatchedNeuralForward::PackedLayer::PackedLayer(const DenseLayer& layer)
    : depth(layer.weight.cols()) {
  const Eigen::Index outputs = layer.weight.rows();
  const Eigen::Index blocks = (outputs + outputs_in_block - 1) / outputs_in_block;
  bias.assign(static_cast<std::size_t>(blocks * outputs_in_block), 0.0F);
  weights.assign(bias.size() * static_cast<std::size_t>(depth), 0.0F);
  for (Eigen::Index output = 0; output < outputs; ++output) {
    const Eigen::Index block = output / outputs_in_block;
    bias[static_cast<std::size_t>(output)] = layer.bias[output];
    for (Eigen::Index k = 0; k < depth; ++k) {
      const Eigen::Index at = (block * depth + k) * outputs_in_block + output % outputs_in_block;
      weights[static_cast<std::size_t>(at)] = layer.weight(output, k);
    }
  }
}

BatchedNeuralForward::BatchedNeuralForward(std::shared_ptr<const NeuralNetwork> network,
                                           Eigen::Index batch)
    : network_(checked(std::move(network), batch)),
      gru_input_(network_->gru_input),
      gru_hidden_(network_->gru_hidden),
      first_layer_(network_->first),
      second_layer_(network_->second),
      heads_(network_->heads),
      batch_(batch),
      width_((batch + narrow_lanes - 1) / narrow_lanes * narrow_lanes),
      standardised_(Rows::Zero(neural_input_count, width_)),
      hidden_(Rows::Zero(network_->hidden(), width_)),
      from_input_(rows_for(gru_input_)),
      from_hidden_(rows_for(gru_hidden_)),
      first_(rows_for(first_layer_)),
      second_(rows_for(second_layer_)),
      last_(rows_for(heads_)),
      outputs_(neural_output_count, batch) {}

BatchedNeuralForward::Rows BatchedNeuralForward::rows_for(const PackedLayer& layer) const {
  return Rows::Zero(static_cast<Eigen::Index>(layer.bias.size()), width_);
}

void BatchedNeuralForward::apply(const PackedLayer& layer, const Rows& x, Rows& y) noexcept {
  multiply({layer.weights.data(), layer.bias.data(), y.rows() / outputs_in_block, layer.depth,
            x.data(), y.data(), y.cols()});
}

const BatchedNeuralForward::Columns& BatchedNeuralForward::step(const Columns& inputs) noexcept {
  const Eigen::Index n = hidden_.rows();
  standardised_.leftCols(batch_) = (inputs.colwise() - network_->input_mean).array();
  standardised_.leftCols(batch_).colwise() *= network_->input_scale.array();

  // The gates of `NeuralForward`.
  apply(gru_input_, standardised_, from_input_);
  apply(gru_hidden_, hidden_, from_hidden_);
  auto gates = from_input_.topRows(2 * n);
  gates = (gates + from_hidden_.topRows(2 * n)).logistic();
  const auto reset = from_input_.topRows(n);
  const auto update = from_input_.middleRows(n, n);
  auto candidate = from_input_.middleRows(2 * n, n);
  candidate = (candidate + reset * from_hidden_.middleRows(2 * n, n)).tanh();
  hidden_ = candidate + update * (hidden_ - candidate);

  apply(first_layer_, hidden_, first_);
  first_ = first_.max(0.0F);
  apply(second_layer_, first_, second_);
  second_ = second_.max(0.0F);
  apply(heads_, second_, last_);
  outputs_ = last_.topLeftCorner(neural_output_count, batch_).matrix();
  return outputs_;
}

}  // namespace touchdown::experiments
