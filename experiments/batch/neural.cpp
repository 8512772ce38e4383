#include "experiments/batch/neural.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace touchdown::experiments {
namespace {

Eigen::RowVectorXf checked_sigmas(std::span<const double> sigmas) {
  if (sigmas.empty()) throw InputError("neural batch: expected at least one noise level");
  Eigen::RowVectorXf row(static_cast<Eigen::Index>(sigmas.size()));
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    if (!(std::isfinite(sigmas[i]) && sigmas[i] >= 0.0)) {
      throw InputError("neural batch: noise levels must be finite and not negative (m/s²)");
    }
    row[static_cast<Eigen::Index>(i)] = static_cast<float>(sigmas[i]);
  }
  return row;
}

}  // namespace

BatchedNeuralNetwork::BatchedNeuralNetwork(std::shared_ptr<const NeuralNetwork> network,
                                           const NeuralEstimatorConfig& config,
                                           std::span<const double> sigmas)
    : sigmas_(checked_sigmas(sigmas)),
      forward_(std::move(network), sigmas_.size()),
      clean_(neural_stride(config.sample_rate, forward_.network().period)),
      draws_(clean_),
      inputs_(neural_input_count, sigmas_.size()),
      p_contact_(sigmas.size(), 0.5) {}

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
