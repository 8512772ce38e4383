#include "apps/training/trainer.hpp"

#include <ATen/Parallel.h>
#include <algorithm>
#include <exception>
#include <sstream>
#include <torch/nn/functional/activation.h>
#include <torch/nn/functional/loss.h>
#include <torch/nn/module.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>
#include <torch/optim/adam.h>
#include <torch/serialize.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "estimator/neural/network.hpp"

namespace touchdown::training {

namespace {

/// The neural measurement network in libtorch: the parameters of `NeuralNetwork`, with gradients.
class TorchNetwork : public torch::nn::Module {
 public:
  explicit TorchNetwork(const NeuralNetwork& network);

  /// The parameters, standardisation included.
  NeuralNetwork numbers() const;

  /// Maps raw inputs (steps × batch × neural_input_count) and hidden state (1 × batch × hidden) to
  /// outputs (steps × batch × neural_output_count) and the next hidden state.
  std::pair<torch::Tensor, torch::Tensor> forward(const torch::Tensor& inputs,
                                                  const torch::Tensor& hidden);

  /// The initial hidden state (1 × batch × hidden).
  torch::Tensor initial_state(std::int64_t batch) const {
    return torch::zeros({1, batch, gru_->options.hidden_size()});
  }

  /// Shares the memory of the parameters of `other`, with separate gradients.
  void share_parameters_of(const TorchNetwork& other);

 private:
  double period_;
  torch::Tensor input_mean_;
  torch::Tensor input_scale_;
  torch::nn::GRU gru_;
  torch::nn::Linear first_;
  torch::nn::Linear second_;
  torch::nn::Linear heads_;
};

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

torch::Tensor to_tensor(const Eigen::MatrixXf& matrix) {
  RowMajor rows = matrix;
  return torch::from_blob(rows.data(), {matrix.rows(), matrix.cols()}).clone();
}

Eigen::MatrixXf to_matrix(const torch::Tensor& tensor) {
  const torch::Tensor rows = tensor.detach().contiguous();
  return Eigen::Map<const RowMajor>(rows.data_ptr<float>(), rows.size(0), rows.size(1));
}

Eigen::VectorXf to_vector(const torch::Tensor& tensor) {
  const torch::Tensor numbers = tensor.detach().contiguous();
  return Eigen::Map<const Eigen::VectorXf>(numbers.data_ptr<float>(), numbers.size(0));
}

void set(const torch::Tensor& weight, const torch::Tensor& bias, const DenseLayer& layer) {
  const torch::NoGradGuard no_grad;
  weight.copy_(to_tensor(layer.weight));
  bias.copy_(to_tensor(layer.bias).flatten());
}

torch::nn::Linear linear(const DenseLayer& layer) {
  torch::nn::Linear module(layer.weight.cols(), layer.weight.rows());
  set(module->weight, module->bias, layer);
  return module;
}

DenseLayer layer(const torch::Tensor& weight, const torch::Tensor& bias) {
  return {to_matrix(weight), to_vector(bias)};
}

TorchNetwork::TorchNetwork(const NeuralNetwork& network)
    : period_(network.period),
      input_mean_(register_buffer("input_mean", to_tensor(network.input_mean).flatten())),
      input_scale_(register_buffer("input_scale", to_tensor(network.input_scale).flatten())),
      gru_(register_module(
          "gru", torch::nn::GRU(torch::nn::GRUOptions(neural_input_count, network.hidden())))),
      first_(register_module("first", linear(network.first))),
      second_(register_module("second", linear(network.second))),
      heads_(register_module("heads", linear(network.heads))) {
  const auto weights = gru_->named_parameters();
  set(weights["weight_ih_l0"], weights["bias_ih_l0"], network.gru_input);
  set(weights["weight_hh_l0"], weights["bias_hh_l0"], network.gru_hidden);
}

NeuralNetwork TorchNetwork::numbers() const {
  const auto weights = gru_->named_parameters();
  NeuralNetwork network;
  network.period = period_;
  network.input_mean = to_vector(input_mean_);
  network.input_scale = to_vector(input_scale_);
  network.gru_input = layer(weights["weight_ih_l0"], weights["bias_ih_l0"]);
  network.gru_hidden = layer(weights["weight_hh_l0"], weights["bias_hh_l0"]);
  network.first = layer(first_->weight, first_->bias);
  network.second = layer(second_->weight, second_->bias);
  network.heads = layer(heads_->weight, heads_->bias);
  return network;
}

std::pair<torch::Tensor, torch::Tensor> TorchNetwork::forward(const torch::Tensor& inputs,
                                                              const torch::Tensor& hidden) {
  auto [features, next_hidden] = gru_->forward((inputs - input_mean_) * input_scale_, hidden);
  features = torch::relu(first_->forward(features));
  features = torch::relu(second_->forward(features));
  return {heads_->forward(features), next_hidden};
}

void TorchNetwork::share_parameters_of(const TorchNetwork& other) {
  const auto mine = parameters();
  const auto theirs = other.parameters();
  for (std::size_t i = 0; i < mine.size(); ++i) {
    mine[i].set_data(theirs[i].detach());
  }
}

using torch::Tensor;
namespace functional = torch::nn::functional;

/// Some environments of a batch, as tensors that view it.
struct Part {
  std::int64_t first = 0;
  std::int64_t environments = 0;
  Tensor input;
  Tensor contact;
  Tensor velocity;
  Tensor keep;
  std::int64_t sequence = 1;  ///< steps of a sequence

  Tensor rows(const Tensor& all, std::int64_t s) const {
    return all.narrow(0, s * sequence, sequence);
  }
  /// Outputs and next hidden state over sequence `s`.
  std::pair<Tensor, Tensor> forward(TorchNetwork& network, const Tensor& hidden,
                                    std::int64_t s) const {
    return network.forward(rows(input, s), hidden * keep[s].unsqueeze(0));
  }
};

/// A tensor that views the numbers. Tensors have no const form; these are only read.
Tensor view(const std::vector<float>& numbers, std::int64_t rows, std::int64_t environments,
            std::int64_t columns) {
  return torch::from_blob(const_cast<float*>(numbers.data()), {rows, environments, columns});
}

std::vector<Part> split(const EpisodeBatch& batch, int most_parts) {
  const std::int64_t environments = batch.environments;
  const std::int64_t parts = std::min<std::int64_t>(most_parts, environments);
  const Tensor input = view(batch.input, batch.steps, environments, neural_input_count);
  const Tensor contact = view(batch.contact, batch.steps, environments, 1);
  const Tensor velocity = view(batch.velocity, batch.steps, environments, 3);
  const Tensor keep = view(batch.keep, batch.steps / batch.sequence, environments, 1);
  std::vector<Part> split;
  for (std::int64_t p = 0; p < parts; ++p) {
    const std::int64_t first = p * environments / parts;
    const std::int64_t count = (p + 1) * environments / parts - first;
    split.push_back({first, count, input.narrow(1, first, count), contact.narrow(1, first, count),
                     velocity.narrow(1, first, count), keep.narrow(1, first, count),
                     batch.sequence});
  }
  return split;
}

/// Sums over steps, divided at the end.
struct LossSum {
  double contact = 0.0;
  double velocity = 0.0;
  double correct = 0.0;
  double steps = 0.0;

  LossSum& operator+=(const LossSum& other) {
    contact += other.contact;
    velocity += other.velocity;
    correct += other.correct;
    steps += other.steps;
    return *this;
  }
};

struct SequenceLoss {
  Tensor contact;   ///< mean
  Tensor velocity;  ///< mean
  LossSum sum;
};

SequenceLoss loss_of(const Tensor& outputs, const Part& part, std::int64_t s) {
  const Tensor logit = outputs.narrow(2, 0, 1);
  const Tensor contact = part.rows(part.contact, s);
  SequenceLoss loss;
  loss.contact = functional::binary_cross_entropy_with_logits(logit, contact);
  loss.velocity = functional::mse_loss(outputs.narrow(2, 1, 3), part.rows(part.velocity, s));
  const auto steps = static_cast<double>(logit.numel());
  loss.sum.contact = steps * loss.contact.item<double>();
  loss.sum.velocity = steps * loss.velocity.item<double>();
  loss.sum.correct = (logit.detach().ge(0.0) == contact.ge(0.5)).sum().item<double>();
  loss.sum.steps = steps;
  return loss;
}

/// Runs `work` on all parts in parallel. In an OpenMP region, OpenBLAS and libtorch both use one
/// thread per part. Errors: rethrows that of the first part that failed.
template <typename Work>
void for_each_part(std::size_t parts, const Work& work) {
  std::vector<std::exception_ptr> errors(parts);
  const int count = static_cast<int>(parts);
#pragma omp parallel for schedule(static, 1)
  for (int i = 0; i < count; ++i) {
    const auto part = static_cast<std::size_t>(i);
    try {
      work(part);
    } catch (...) {
      errors[part] = std::current_exception();
    }
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace

void set_training_threads(int threads) { at::set_num_threads(threads); }

struct Trainer::Impl {
  Impl(const NeuralNetwork& network, const OptimiserConfig& given)
      : config(given),
        adam(((void)networks.push_back(std::make_shared<TorchNetwork>(network)),
              networks[0]->parameters()),
             torch::optim::AdamOptions(given.learning_rate)) {
    for (int part = 1; part < config.parts; ++part) {
      networks.push_back(std::make_shared<TorchNetwork>(network));
      networks.back()->share_parameters_of(*networks[0]);
    }
  }

  /// One optimiser step on one sequence of all parts.
  LossSum step(const std::vector<Part>& parts, std::vector<Tensor>& hidden, std::int64_t s,
               std::int64_t environments) {
    std::vector<LossSum> sums(parts.size());
    for_each_part(parts.size(), [&](std::size_t p) {
      const Part& part = parts[p];
      const auto [outputs, next] = part.forward(*networks[p], hidden[p], s);
      hidden[p] = next.detach();
      const SequenceLoss loss = loss_of(outputs, part, s);
      sums[p] = loss.sum;
      networks[p]->zero_grad();
      const double share =
          static_cast<double>(part.environments) / static_cast<double>(environments);
      (share * (loss.contact + config.velocity_weight * loss.velocity)).backward();
    });
    add_gradients(parts.size());
    adam.step();
    LossSum sum;
    for (const LossSum& part : sums) sum += part;
    return sum;
  }

  /// Adds in the order of the parts, so that rounding does not depend on timing.
  void add_gradients(std::size_t parts) {
    const auto total = networks[0]->parameters();
    for (std::size_t p = 1; p < parts; ++p) {
      const auto own = networks[p]->parameters();
      for (std::size_t i = 0; i < total.size(); ++i) total[i].mutable_grad() += own[i].grad();
    }
  }

  std::vector<std::vector<std::int64_t>> shapes() const {
    std::vector<std::vector<std::int64_t>> all;
    for (const Tensor& parameter : networks[0]->parameters())
      all.push_back(parameter.sizes().vec());
    return all;
  }

  Loss mean(const LossSum& sum) const {
    const double contact = sum.contact / sum.steps;
    const double velocity = sum.velocity / sum.steps;
    return {contact, velocity, contact + config.velocity_weight * velocity,
            sum.correct / sum.steps};
  }

  OptimiserConfig config;
  /// One network per part. All share the parameters of the first, with separate gradients.
  std::vector<std::shared_ptr<TorchNetwork>> networks;
  torch::optim::Adam adam;
};

Trainer::Trainer(const NeuralNetwork& network, const OptimiserConfig& config)
    : impl_(std::make_unique<Impl>(network, config)) {}
Trainer::~Trainer() = default;

Loss Trainer::train_epoch(const EpisodeBatch& batch, const StopIfAsked& stop_if_asked) {
  const std::vector<Part> parts = split(batch, impl_->config.parts);
  std::vector<Tensor> hidden;
  for (const Part& part : parts)
    hidden.push_back(impl_->networks[0]->initial_state(part.environments));
  LossSum sum;
  for (std::int64_t s = 0; s < batch.steps / batch.sequence; ++s) {
    if (stop_if_asked) stop_if_asked();
    sum += impl_->step(parts, hidden, s, batch.environments);
  }
  return impl_->mean(sum);
}

Loss Trainer::evaluate(const EpisodeBatch& batch, const StopIfAsked& stop_if_asked) const {
  const std::vector<Part> parts = split(batch, impl_->config.parts);
  std::vector<LossSum> sums(parts.size());
  for_each_part(parts.size(), [&](std::size_t p) {
    const torch::NoGradGuard no_grad;  // applies to this thread only
    const Part& part = parts[p];
    Tensor hidden = impl_->networks[p]->initial_state(part.environments);
    for (std::int64_t s = 0; s < batch.steps / batch.sequence; ++s) {
      if (stop_if_asked) stop_if_asked();
      const auto [outputs, next] = part.forward(*impl_->networks[p], hidden, s);
      hidden = next;
      sums[p] += loss_of(outputs, part, s).sum;
    }
  });
  LossSum sum;
  for (const LossSum& part : sums) sum += part;
  return impl_->mean(sum);
}

std::vector<float> Trainer::outputs(const EpisodeBatch& batch) const {
  const torch::NoGradGuard no_grad;
  const Part all = split(batch, 1).front();
  Tensor hidden = impl_->networks[0]->initial_state(all.environments);
  std::vector<float> result;
  for (std::int64_t s = 0; s < batch.steps / batch.sequence; ++s) {
    auto [outputs, next] = all.forward(*impl_->networks[0], hidden, s);
    hidden = next;
    const Tensor numbers = outputs.contiguous();
    result.insert(result.end(), numbers.data_ptr<float>(),
                  numbers.data_ptr<float>() + numbers.numel());
  }
  return result;
}

NeuralNetwork Trainer::network() const { return impl_->networks[0]->numbers(); }

void Trainer::save(const std::filesystem::path& path) const {
  torch::serialize::OutputArchive archive;
  torch::serialize::OutputArchive network;
  torch::serialize::OutputArchive adam;
  impl_->networks[0]->save(network);
  impl_->adam.save(adam);
  archive.write("network", network);
  archive.write("adam", adam);
  // Given a path, libtorch would write its name into the file.
  std::ostringstream bytes;
  archive.save_to(bytes);
  write_atomically(path, bytes.str());
}

void Trainer::load(const std::filesystem::path& path) {
  try {
    torch::serialize::InputArchive archive;
    archive.load_from(path.string());
    torch::serialize::InputArchive network;
    torch::serialize::InputArchive adam;
    archive.read("network", network);
    archive.read("adam", adam);
    const auto shapes = impl_->shapes();
    impl_->networks[0]->load(network);  // accepts any shape
    if (impl_->shapes() != shapes) throw InputError("other shapes");
    impl_->adam.load(adam);
  } catch (const std::exception&) {
    // Replaces libtorch's messages, which are pages long.
    throw InputError(fmt::format("{}: is not a checkpoint of this network; remove it to start anew",
                                 path.string()));
  }
  for (std::size_t p = 1; p < impl_->networks.size(); ++p) {
    impl_->networks[p]->share_parameters_of(*impl_->networks[0]);
  }
}

}  // namespace touchdown::training
