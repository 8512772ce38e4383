#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/models/parameters.hpp"
#include "estimator/numerics/number_text.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/logs/fit.hpp"

namespace touchdown::experiments {

namespace {

EvidenceCurveSets curves_of(const FitPrior& prior) {
  if (std::optional<EvidenceCurveSets> curves = evidence_in(prior.model)) return *curves;
  const std::string found = estimator_of(prior.model);
  throw InputError(fmt::format("--prior: {}: expected a model of evidence_curves, found one of {}",
                               prior.name, found.empty() ? "densities" : found));
}

/// What `make` makes, with the file's name in errors.
auto naming(const FitPrior& prior, const auto& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(fmt::format("--prior: {}: {}", prior.name, error.what()));
  }
}

/// The same mean of the thresholds, which the curves' scale goes with.
void mix_thresholds(const ConfigurationText& prior, double weight, ConfigurationText& own) {
  for (const char* const name : operating_point_keys) {
    const auto other = prior.find(name);
    const auto value = own.find(name);
    if (other == prior.end() || value == own.end()) continue;
    const double mean = weight * number_of(value->second).value() +
                        (1.0 - weight) * number_of(other->second).value();
    value->second = text_of(mean);
  }
}

}  // namespace

void check_prior(const FitPrior& prior, const EstimatorEntry& entry, bool servo_load) {
  if (!share_model(entry, evidence_curves_entry())) {
    throw InputError(fmt::format(
        "--prior: expected --estimator evidence_curves, because curves add up, found {}",
        entry.name));
  }
  EvidenceCurveSets fitted;  // its channels
  if (servo_load) {
    fitted.usual.servo_curve.resize(std::tuple_size_v<ServoLoadInputs>);
    fitted.without_targets.emplace();
  }
  const EvidenceCurveSets curves = curves_of(prior);
  naming(prior, [&] { return mean_of(fitted, curves, 1.0); });
}

void add_prior(const FitPrior& prior, LogFitReport& report, Model& model) {
  const double seconds = 0.5 * static_cast<double>(std::min(report.samples[0], report.samples[1])) /
                         report.fitted_to.sample_rate;
  report.weight = seconds / (seconds + prior_seconds);
  std::string fingerprint = "unknown";
  if (const std::optional<ModelMetadata>& metadata = prior.model.metadata) {
    naming(prior, [&] { check_use(*metadata, {.sample_rate = report.fitted_to.sample_rate}); });
    mix_thresholds(metadata->configuration, report.weight, model.metadata->configuration);
    fingerprint = metadata->fingerprint;
  }
  const EvidenceCurveSets mean =
      mean_of(evidence_in(model).value(), curves_of(prior), report.weight);
  for (auto& [name, array] : arrays_of(parameters_of(mean), model.metadata->estimator)) {
    model.arrays[name] = std::move(array);
  }
  add_to_provenance("prior", fmt::format("{} {}", prior.name, fingerprint), model);
  add_to_provenance("weight_beside_prior", text_of(report.weight), model);
}

}  // namespace touchdown::experiments
