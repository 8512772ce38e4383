#include "experiments/batch/neural.hpp"

#include <cmath>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace touchdown::experiments {
namespace {

/// Outputs that are computed together: their sums fill the registers, and each is a chain of its
/// own, so that no multiplication waits for another.
constexpr int outputs_in_block = 12;
constexpr Eigen::Index narrow_lanes = 8;

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
using WideVector [[gnu::vector_size(4 * 16)]] = float;

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

Eigen::RowVectorXf sigmas_of(std::span<const BatchNoise> levels) {
  check_levels(levels);
  Eigen::RowVectorXf sigmas(static_cast<Eigen::Index>(levels.size()));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    sigmas[static_cast<Eigen::Index>(i)] = static_cast<float>(levels[i].acceleration);
  }
  return sigmas;
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
      layers_(*network_),
      outputs_(neural_output_count, batch) {
  const Eigen::Index width = (batch + narrow_lanes - 1) / narrow_lanes * narrow_lanes;
  const auto rows = [width](std::size_t count) {
    return Rows(Rows::Zero(static_cast<Eigen::Index>(count), width));
  };
  values_ = {rows(neural_input_count),
             rows(static_cast<std::size_t>(network_->hidden())),
             rows(layers_.gru_input.bias.size()),
             rows(layers_.gru_hidden.bias.size()),
             rows(layers_.first.bias.size()),
             rows(layers_.second.bias.size()),
             rows(layers_.heads.bias.size())};
}

const BatchedNeuralForward::Columns& BatchedNeuralForward::step(const Columns& inputs) noexcept {
  auto standardised = values_.standardised.leftCols(outputs_.cols());
  standardised = inputs.colwise() - network_->input_mean;
  standardised.array().colwise() *= network_->input_scale.array();
  neural_step(layers_, values_, [](const PackedLayer& layer, const Rows& x, Rows& y) {
    multiply({layer.weights.data(), layer.bias.data(), y.rows() / outputs_in_block, layer.depth,
              x.data(), y.data(), y.cols()});
  });
  outputs_ = values_.outputs.topLeftCorner(neural_output_count, outputs_.cols());
  return outputs_;
}

BatchedNeuralNetwork::BatchedNeuralNetwork(std::shared_ptr<const NeuralNetwork> network,
                                           const NeuralEstimatorConfig& config,
                                           std::span<const BatchNoise> levels)
    : sigmas_(sigmas_of(levels)),
      forward_(std::move(network), sigmas_.size()),
      clean_(neural_stride(config.sample_rate, forward_.network().period)),
      draws_(clean_),
      inputs_(neural_input_count, sigmas_.size()),
      p_contact_(levels.size(), 0.5) {}

void BatchedNeuralNetwork::update(const Signals& clean, const Eigen::Vector3d& draw) noexcept {
  if (!neural_input(clean).allFinite() || !draw.allFinite()) {
    clean_.skip();
    draws_.skip();
    return;
  }
  Signals noise;
  noise.linear_acceleration = draw;
  draws_.add(noise);
  if (!clean_.add(clean)) return;
  inputs_.colwise() = clean_.input();
  inputs_.topRows<3>().noalias() += draws_.input().head<3>() * sigmas_;
  const auto& outputs = forward_.step(inputs_);
  for (std::size_t i = 0; i < p_contact_.size(); ++i) {
    const double logit = outputs(0, static_cast<Eigen::Index>(i));
    p_contact_[i] = 1.0 / (1.0 + std::exp(-logit));
  }
}

}  // namespace touchdown::experiments
