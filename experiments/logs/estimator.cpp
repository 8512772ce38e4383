#include "experiments/logs/estimator.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/resources.hpp"
#include "estimator/models/configuration.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "estimator/numerics/number_text.hpp"
#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The default estimator of a model: the one it was fitted for, `robust` for a grid that names
/// none.
const EstimatorEntry& usual_estimator(const Model& model) {
  const std::string name = estimator_of(model);
  return estimator_entry(name.empty() ? "robust" : name);
}

/// Of the load filter it is the robot's geometry.
bool takes_model(const EstimatorEntry& entry) { return entry.making.by_step == make_of_model; }

/// Errors: `InputError` that names the file, for numbers or a configuration that the estimator
/// cannot be made with.
void check_model(const EstimatorEntry& entry, const Model& model,
                 const std::filesystem::path& path) {
  try {
    entry.make({.model = &model});
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

/// Errors: `InputError` for a model that this estimator cannot use.
void check_fit(const EstimatorEntry& entry, const Model& model, const std::filesystem::path& path) {
  const EstimatorEntry& usual = usual_estimator(model);
  if (!takes_model(usual)) {
    throw InputError(fmt::format("{}: is the model of '{}', which needs no --model here",
                                 path.string(), usual.name));
  }
  if (entry.name == usual.name) return;
  // A grid without metadata serves every filter of torques.
  if (model.metadata ? share_model(entry, usual) : entry.fitting.torques.has_value()) return;
  throw InputError(
      fmt::format("{}: is a model of '{}', which '{}' cannot use (did you mean --estimator {}?)",
                  path.string(), usual.name, entry.name, usual.name));
}

void check_needs(const EstimatorEntry& entry, const std::filesystem::path& model) {
  if (entry.knows.truth) {
    throw InputError(fmt::format(
        "--estimator: the {} repeats the ground truth and does not run on logs", entry.name));
  }
  if (!takes_model(entry) && !model.empty()) {
    throw InputError(fmt::format("--model: '{}' is not fitted and takes none", entry.name));
  }
  if (entry.fits() && model.empty()) {
    throw InputError(fmt::format(
        "--model is missing: '{0}' has to be fitted: touchdown fit LOG --estimator {0} -o "
        "model.npz",
        entry.name));
  }
}

/// The entry with the configuration from its own model's metadata.
EstimatorEntry configured(EstimatorEntry entry, const Model& model) {
  if (!model.metadata || model.metadata->estimator != entry.name) return entry;
  const ConfigurationText& stored = model.metadata->configuration;
  for (const auto& [key, value] : stored) entry.configuration[key] = value;
  entry.configured_rate = model.metadata->sample_rate;
  for (Hyperparameter& hyperparameter : entry.hyperparameters) {
    const auto value = stored.find(hyperparameter.name);
    if (value == stored.end()) continue;
    hyperparameter.value = number_of(value->second).value_or(hyperparameter.value);
  }
  return entry;
}

}  // namespace

std::unique_ptr<ContactEstimator> LogEstimator::make(double sample_rate,
                                                     const logs::RecordingInfo& log) const {
  if (model.metadata) {
    const auto check = [this](const ModelUse& use, const char* advice) {
      try {
        check_use(*model.metadata, use);
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}{}", request.model.string(), error.what(), advice));
      }
    };
    check({.sample_rate = sample_rate}, "");
    const std::string& named = request.robot.name;
    check({.robot = request.transfer ? ""
                    : named.empty()  ? robot_of(log)
                                     : named},
          " (--transfer uses it all the same; in Python, transfer=True)");
  }
  // Clocks jitter, and some estimators support only certain rates.
  const bool is_fitted_rate =
      model.metadata && is_same_rate(sample_rate, model.metadata->sample_rate);
  const double rate = is_fitted_rate ? model.metadata->sample_rate : sample_rate;
  const std::optional<LegGeometry> legs =
      entry.knows.geometry ? checked_robot(request.robot, log).legs : request.robot.legs;
  std::unique_ptr<ContactEstimator> made = entry.make({.sample_rate = rate,
                                                       .model = &model,
                                                       .legs = legs,
                                                       .configured_rate = entry.configured_rate});
  if (model.metadata) made->limit_signals(signal_bounds_of(model.metadata->configuration));
  return made;
}

std::string LogEstimator::model_text() const {
  if (request.model.empty()) return {};
  if (!model.metadata) {
    return fmt::format("{}: has no metadata (an older or external file): used with '{}'",
                       request.model.string(), entry.name);
  }
  const ModelMetadata& metadata = *model.metadata;
  return fmt::format("{}: fitted for '{}' at {:.6g} Hz to {}, fingerprint {}",
                     request.model.string(), metadata.estimator, metadata.sample_rate,
                     robot_text(metadata.robot), metadata.fingerprint);
}

LogEstimator log_estimator(LogEstimatorRequest request) {
  if (request.name.empty() && request.model.empty()) request.name = default_estimator;
  if (!request.name.empty()) check_needs(estimator_entry(request.name), request.model);
  if (request.model.empty()) {
    const EstimatorEntry& entry = estimator_entry(request.name);
    check_names(request.hyperparameters, entry);
    return {with_hyperparameters(entry, request.hyperparameters), {}, request};
  }
  request.model = find_resource(request.model);
  Model model = load_model(request.model);
  const EstimatorEntry& entry =
      request.name.empty() ? usual_estimator(model) : estimator_entry(request.name);
  check_fit(entry, model, request.model);
  EstimatorEntry own = configured(entry, model);
  check_model(own, model, request.model);
  if (own.knows.geometry && !request.robot.legs) {
    LoadFilterConfig config;
    configure(config, own.configuration);
    request.robot.legs = config.geometry;
  }
  check_names(request.hyperparameters, entry);
  for (const Hyperparameter& hyperparameter : entry.hyperparameters) {
    const std::string& name = hyperparameter.name;
    if (!hyperparameter.is_fitted_with || !request.hyperparameters.contains(name)) continue;
    throw InputError(fmt::format("'{0}' is fixed by the fit: touchdown fit --set {0}={1}", name,
                                 text_of(request.hyperparameters.at(name))));
  }
  if (model.metadata) put_into(*model.metadata, request.hyperparameters);
  own.title = fmt::format("{} ({})", own.title, request.model.string());
  return {with_hyperparameters(std::move(own), request.hyperparameters), std::move(model),
          std::move(request)};
}

LogEstimator log_estimator(const EstimatorEntry& entry, Model model, const LogRobot& robot) {
  EstimatorEntry own = configured(entry, model);
  return {std::move(own), std::move(model), {.robot = robot, .transfer = true}};
}

}  // namespace touchdown::experiments
