#include "experiments/estimator_registry.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "estimator/free_fall.hpp"
#include "estimator/measurement_only.hpp"
#include "estimator/neural_estimator.hpp"
#include "estimator/phase_filter.hpp"
#include "estimator/wheel_contact_observer.hpp"
#include "experiments/always_contact.hpp"
#include "experiments/fitting.hpp"
#include "experiments/neural_network_file.hpp"
#include "experiments/oracle.hpp"

namespace touchdown {

namespace {

BayesFilterConfig at_rate(const EstimatorEntry& entry, double sample_rate) {
  BayesFilterConfig config = *entry.config;
  config.sample_rate = sample_rate;
  return config;
}

std::unique_ptr<ContactEstimator> make_bayes_filter(const EstimatorEntry& entry,
                                                    const FittedModel* model, double sample_rate) {
  return std::make_unique<BayesFilter>(*model->measurement, at_rate(entry, sample_rate));
}

std::unique_ptr<ContactEstimator> make_measurement_only(const EstimatorEntry& entry,
                                                        const FittedModel* model,
                                                        double sample_rate) {
  return std::make_unique<MeasurementOnly>(*model->measurement, at_rate(entry, sample_rate));
}

std::unique_ptr<ContactEstimator> make_phase_filter(const EstimatorEntry& entry,
                                                    const FittedModel* model, double sample_rate) {
  PhaseFilterConfig config = *entry.phase;
  config.sample_rate = sample_rate;
  return std::make_unique<PhaseFilter>(model->phase->model, config);
}

std::unique_ptr<ContactEstimator> make_neural_estimator(const EstimatorEntry& /*entry*/,
                                                        const FittedModel* /*model*/,
                                                        double sample_rate) {
  NeuralEstimatorConfig config;
  config.sample_rate = sample_rate;
  return std::make_unique<NeuralEstimator>(
      std::make_shared<const NeuralNetwork>(shipped_neural_network()), config);
}

std::unique_ptr<ContactEstimator> make_upkie_observer(const EstimatorEntry& /*entry*/,
                                                      const FittedModel* /*model*/,
                                                      double sample_rate) {
  UpkieObserverConfig config;
  config.time_step = 1.0 / sample_rate;
  return std::make_unique<UpkieObserver>(config);
}

std::unique_ptr<ContactEstimator> make_free_fall(const EstimatorEntry& /*entry*/,
                                                 const FittedModel* /*model*/, double sample_rate) {
  FreeFallConfig config;
  config.sample_rate = sample_rate;
  return std::make_unique<FreeFall>(config);
}

std::unique_ptr<ContactEstimator> make_oracle(const EstimatorEntry& /*entry*/,
                                              const FittedModel* /*model*/,
                                              double /*sample_rate*/) {
  return std::make_unique<Oracle>();
}

std::unique_ptr<ContactEstimator> make_always_contact(const EstimatorEntry& /*entry*/,
                                                      const FittedModel* /*model*/,
                                                      double /*sample_rate*/) {
  return std::make_unique<AlwaysContact>();
}

}  // namespace

std::span<const EstimatorEntry> estimator_entries() {
  static const std::vector<EstimatorEntry> entries = {
      {"robust", "Bayes filter (robust)", BayesFilterConfig::robust(), std::nullopt,
       make_bayes_filter},
      {"reference", "Bayes filter (reference)", BayesFilterConfig::reference(), std::nullopt,
       make_bayes_filter},
      {"paper", "Bayes filter (paper)", BayesFilterConfig::paper(), std::nullopt,
       make_bayes_filter},
      {"measurement_only", "Measurement only", BayesFilterConfig::robust(), std::nullopt,
       make_measurement_only},
      {"phase", "Phase filter", std::nullopt, PhaseFilterConfig{}, make_phase_filter},
      {"nmn", "NMN", std::nullopt, std::nullopt, make_neural_estimator},
      {"upkie_observer", "Upkie's observer", std::nullopt, std::nullopt, make_upkie_observer},
      {"free_fall", "Free fall", std::nullopt, std::nullopt, make_free_fall},
      {"oracle", "Oracle", std::nullopt, std::nullopt, make_oracle},
      {std::string(always_contact_name), "Always contact", std::nullopt, std::nullopt,
       make_always_contact},
  };
  return entries;
}

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const EstimatorEntry& entry : estimator_entries()) names.push_back(entry.name);
  return names;
}

const EstimatorEntry& estimator_entry(std::string_view name) {
  const std::span<const EstimatorEntry> entries = estimator_entries();
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const EstimatorEntry& entry) { return entry.name == name; });
  if (found != entries.end()) return *found;
  const std::string near = nearest(name, estimator_names());
  throw InputError(fmt::format("unknown estimator '{}': expected one of {}{}", name,
                               fmt::join(estimator_names(), ", "),
                               near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

}  // namespace touchdown
