#include "experiments/logs/estimator.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The estimator that such a model is usually for: the first that is fitted with one, or the one
/// that the parameters in the file belong to.
const EstimatorEntry& usual_estimator(ModelKind kind, const std::filesystem::path& path) {
  if (kind == ModelKind::parameters) {
    return estimator_entry(recordings::read_parameter_model(path).estimator);
  }
  const std::span<const EstimatorEntry> all = estimator_entries();
  return *std::find_if(all.begin(), all.end(),
                       [&](const EstimatorEntry& entry) { return entry.fits() == kind; });
}

std::string described(ModelKind kind, const EstimatorEntry& usual, const EstimatorEntry& entry) {
  if (kind == ModelKind::parameters) return fmt::format("a model of '{}'", usual.name);
  if (kind == ModelKind::phase) return "a phase model";
  return entry.fits() == ModelKind::phase ? "no phase model" : "a model of torques' densities";
}

/// Errors: `InputError` that names the file, for parameters that the estimator cannot be made with.
void check_parameters(const EstimatorEntry& entry, const FittedModel& model,
                      const std::filesystem::path& path) {
  try {
    entry.make(entry, {.model = &model});
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

FittedModel read_model(const EstimatorEntry& entry, const std::filesystem::path& path) {
  if (!entry.fits()) {
    if (path.empty()) return {};
    throw InputError(fmt::format("--model: '{}' is not fitted and takes none", entry.name));
  }
  if (path.empty()) {
    throw InputError(fmt::format(
        "--model is missing: '{0}' has to be fitted: touchdown fit LOG --estimator {0} -o "
        "model.npz",
        entry.name));
  }
  const ModelKind kind = kind_of_model_file(path);
  const EstimatorEntry& usual = usual_estimator(kind, path);
  const bool fits =
      kind == ModelKind::parameters ? share_model(entry, usual) : kind == entry.fits();
  if (!fits) {
    throw InputError(fmt::format("{}: is {}, which '{}' cannot use (did you mean --estimator {}?)",
                                 path.string(), described(kind, usual, entry), entry.name,
                                 usual.name));
  }
  FittedModel model = read_fitted_model(kind, path);
  if (kind == ModelKind::parameters) check_parameters(entry, model, path);
  return model;
}

}  // namespace

std::unique_ptr<ContactEstimator> LogEstimator::make(double sample_rate) const {
  EstimatorEntry at_rate = entry;
  if (at_rate.config) {
    const BayesFilterConfig& usual = *entry.config;
    at_rate.config->transition.window = std::max(
        2,
        static_cast<int>(std::lround(usual.transition.window * sample_rate / usual.sample_rate)));
  }
  return at_rate.make(at_rate, {sample_rate, &model});
}

LogEstimator log_estimator(const std::string& name, const std::filesystem::path& model) {
  const EstimatorEntry& entry =
      !name.empty()
          ? estimator_entry(name)
          : usual_estimator(model.empty() ? ModelKind::measurement : kind_of_model_file(model),
                            model);
  if (entry.needs_truth) {
    throw InputError(fmt::format(
        "--estimator: the {} repeats the ground truth, it does not listen to logs", entry.name));
  }
  return {entry, read_model(entry, model)};
}

}  // namespace touchdown::experiments
