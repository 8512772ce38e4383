#include "experiments/logs/estimator.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The first estimator that is fitted with such a model.
const EstimatorEntry& usual_estimator(ModelKind kind) {
  const std::span<const EstimatorEntry> all = estimator_entries();
  return *std::find_if(all.begin(), all.end(),
                       [&](const EstimatorEntry& entry) { return entry.fits() == kind; });
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
  if (kind != entry.fits()) {
    throw InputError(fmt::format("{}: is {}, which '{}' cannot use (did you mean --estimator {}?)",
                                 path.string(),
                                 kind == ModelKind::phase ? "a phase model" : "no phase model",
                                 entry.name, usual_estimator(kind).name));
  }
  return read_fitted_model(kind, path);
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
          : usual_estimator(model.empty() ? ModelKind::measurement : kind_of_model_file(model));
  if (entry.needs_truth) {
    throw InputError(fmt::format(
        "--estimator: the {} repeats the ground truth, it does not listen to logs", entry.name));
  }
  return {entry, read_model(entry, model)};
}

}  // namespace touchdown::experiments
