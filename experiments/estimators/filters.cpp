#include <fmt/format.h>

#include "core/error.hpp"
#include "core/resources.hpp"
#include "estimator/models/configuration.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "estimator/numerics/number_text.hpp"
#include "experiments/batch/bayes.hpp"
#include "experiments/batch/neural.hpp"
#include "experiments/estimators/entries.hpp"

namespace touchdown::experiments {

namespace {

using Levels = std::span<const noise::SensorNoise>;

/// The entry's settings in a struct of the library, at this sample rate (Hz).
template <typename Config>
Config configured(const EstimatorEntry& entry, double sample_rate) {
  Config config;
  config.sample_rate = sample_rate;
  configure(config, entry.configuration);
  return config;
}

std::vector<BatchNoise> batch_noise(Levels levels) {
  std::vector<BatchNoise> batch;
  for (const noise::SensorNoise& level : levels) {
    batch.push_back({level.knee_torque, level.wheel_torque, level.acceleration});
  }
  return batch;
}

/// Includes the floor of the bandwidths if there is one. The filter `paper` has none, as published.
std::vector<Hyperparameter> bayes_hyperparameters(const BayesFilterConfig& config) {
  const Sigmoid& switching = config.transition.switch_sigmoid;
  std::vector<Hyperparameter> hyperparameters = {
      between("threshold", config.threshold, 0.2, 0.95),
      around("transition.switch.offset", switching.offset, 4.0),
      around("transition.switch.slope", switching.slope, 4.0)};
  const double floor = config.measurement.fit.bandwidth_floor.knee;
  if (floor > 0.0) hyperparameters.push_back(fitted_with(around("bandwidth_floor", floor, 4.0)));
  return hyperparameters;
}

template <typename Batch>
std::optional<BatchedEstimator> batch_of_torques(const EstimatorEntry& entry,
                                                 const EstimatorSetup& setup, Levels levels) {
  const auto config = configured<BayesFilterConfig>(entry, setup.sample_rate);
  const auto batch = std::make_shared<Batch>(*setup.model->grid, config, batch_noise(levels));
  return BatchedEstimator{
      [batch](const Signals& clean, const NoiseStep& draws) { batch->update(clean, draws); },
      [batch](Side side) { return batch->p_contact(side); }, config.threshold};
}

Model fit_measurement(const EstimatorEntry& entry, FitRuns runs, double skip) {
  return {.grid = fit_torques(runs, skip, *entry.fitting.torques)};
}

/// The network that comes with the project.
Model network(const EstimatorEntry& entry) {
  const std::string& file = entry.making.model_file;
  std::filesystem::path path;
  try {
    path = find_program_file(file);
  } catch (const InputError&) {
    throw InputError(fmt::format(
        "{0}: {1} is missing; 'touchdown train experiments/{0}.yaml -o {1}' makes it in less than "
        "20 minutes (training needs the packages libtorch-dev and libopenblas0-openmp)",
        entry.name, file));
  }
  return load_model(path);
}

NeuralEstimatorConfig neural_config(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return {.sample_rate = setup.sample_rate, .threshold = entry.chosen("threshold")};
}

std::unique_ptr<ContactEstimator> make_network(const EstimatorEntry& entry,
                                               const EstimatorSetup& setup) {
  return make_with(network(entry),
                   {.estimator = "nmn",
                    .sample_rate = setup.sample_rate,
                    .configuration = {{"threshold", text_of(entry.chosen("threshold"))}}});
}

/// The elements of a batch share the encoder signals, so a batch does not support encoder noise.
std::optional<BatchedEstimator> neural_batch(const EstimatorEntry& entry,
                                             const EstimatorSetup& setup, Levels levels) {
  const bool has_encoder_noise = std::ranges::any_of(levels, [](const noise::SensorNoise& level) {
    return level.joint_position != 0.0 || level.joint_velocity != 0.0;
  });
  if (has_encoder_noise) return std::nullopt;
  const NeuralEstimatorConfig config = neural_config(entry, setup);
  const auto batch = std::make_shared<BatchedNeuralNetwork>(
      std::make_shared<const NeuralNetwork>(neural_network_of(network(entry).arrays)), config,
      batch_noise(levels));
  return BatchedEstimator{[batch](const Signals& clean, const NoiseStep& draws) {
                            const auto& [x, y, z] = draws.linear_acceleration;
                            batch->update(clean, {x, y, z});
                          },
                          [batch](Side /*side*/) { return batch->p_contact(); }, config.threshold};
}

}  // namespace

EstimatorEntry bayes_entry(const std::string& name, const std::string& summary,
                           const std::string& reason, const BayesFilterConfig& config) {
  EstimatorEntry entry{.name = name,
                       .title = "Bayes filter (" + name + ")",
                       .summary = summary,
                       .reason = reason,
                       .sensors = {.knee_torque = true, .wheel_torque = true, .acceleration = true},
                       .hyperparameters = bayes_hyperparameters(config),
                       .configuration = text_of(config),
                       .fitting = {.fit = fit_measurement, .torques = config.measurement},
                       .making = {.by_step = make_of_model},
                       .batching = batch_of_torques<BatchedBayesFilter>};
  // The text of a configuration that does not follow the noise lacks this key.
  entry.configuration["noise.is_followed"] =
      config.measurement.noise.is_followed ? "true" : "false";
  return entry;
}

namespace {

/// The paper's ablation: the robust measurement model without transitions.
EstimatorEntry measurement_only_entry() {
  EstimatorEntry entry = bayes_entry(
      "measurement_only",
      "Estimates contact from a wheel's current torques alone, the paper's ablation",
      "history: the paper's ablation without the accelerometer", BayesFilterConfig::robust());
  entry.title = "Measurement only";
  entry.sensors = {.knee_torque = true, .wheel_torque = true};
  std::erase_if(entry.hyperparameters,
                [](const Hyperparameter& one) { return one.name.starts_with("transition."); });
  entry.batching = batch_of_torques<BatchedMeasurement>;
  return entry;
}

EstimatorEntry neural_entry() {
  return {.name = "nmn",
          .title = "NMN",
          .summary = "Runs the paper's neural network on IMU, joints and command, without torques",
          .reason = "history: the paper's neural baseline, without torques",
          .sensors = {.acceleration = true, .joint_position = true, .joint_velocity = true},
          .hyperparameters = {between("threshold", NeuralEstimatorConfig{}.threshold, 0.2, 0.95)},
          .fitting = {.trained_by = "touchdown train"},
          .making = {.model_file = "models/nmn.npz", .by_step = make_network},
          .batching = neural_batch};
}

/// Trained with the sensor model and noise of a benchmark (experiments/nmn_retrained.yaml).
EstimatorEntry retrained_neural_entry() {
  EstimatorEntry entry = neural_entry();
  entry.name = "nmn_retrained";
  entry.making.model_file = "models/nmn_retrained.npz";
  entry.title = "NMN, retrained";
  entry.summary =
      "Runs the paper's network, retrained on the benchmark's fit scenes with sensor noise";
  entry.reason = "history: the paper's neural baseline on this project's scenes";
  return entry;
}

}  // namespace

TransitionConfig transition_of(const EstimatorEntry& entry) {
  return configured<BayesFilterConfig>(entry, BayesFilterConfig{}.sample_rate).transition;
}

std::vector<EstimatorEntry> filter_entries() {
  return {
      bayes_entry("robust", "Runs the paper's Bayes filter with changes for noisy sensors",
                  "history: the paper's filter, for noisy sensors", BayesFilterConfig::robust()),
      bayes_entry("reference", "Runs the paper's Bayes filter as in the authors' robot code",
                  "history: the authors' robot code", BayesFilterConfig::reference()),
      bayes_entry("paper", "Runs the paper's Bayes filter exactly as published",
                  "history: the paper's filter", BayesFilterConfig::paper()),
      bayes_entry("paper_rms",
                  "Runs the paper's Bayes filter with the power read as a root mean square",
                  "history: another reading of the paper's filter", BayesFilterConfig::paper_rms()),
      measurement_only_entry(),
      neural_entry(),
      retrained_neural_entry()};
}

}  // namespace touchdown::experiments
