#include "experiments/estimators/decision.hpp"

#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/resources.hpp"
#include "estimator/decision/filter.hpp"
#include "estimator/decision/fit.hpp"
#include "estimator/evidence/filter.hpp"
#include "estimator/evidence/fit.hpp"
#include "estimator/evidence/touchdown_fit.hpp"
#include "experiments/estimators/parameter_fitting.hpp"
#include "recordings/models/parameter_model.hpp"

namespace touchdown::experiments {

namespace {

using EstimatorPointer = std::unique_ptr<ContactEstimator>;

DecisionConfig config_of(const FitRuns& runs) {
  return {.geometry = legs_of(runs), .servo_load = runs.servo_load};
}

FittedModel fit_network(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_decision_model(labelled, config_of(runs),
                                            {.decay = entry.chosen("decay")}, runs.before_density));
  });
}

FittedModel fit_touchdown(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    return parameters_of(
        fit_touchdown_model(labelled, config_of(runs), {.decay = entry.chosen("decay")},
                            {.smoothness = entry.chosen("smoothness")}, runs.before_density));
  });
}

template <bool with_pairs>
FittedModel fit_evidence(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_evidence_model(
        labelled, config_of(runs),
        {.smoothness = entry.chosen("smoothness"), .with_pairs = with_pairs}, runs.before_density));
  });
}

template <typename Estimator, auto model_of>
EstimatorPointer make_fitted(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return std::make_unique<Estimator>(
      model_of(setup.model->parameters->parameters),
      configured(DecisionConfig{.sample_rate = setup.sample_rate}, entry, setup));
}

/// Whether both legs, and the robots that they carry, are the same to a percent. Rotors may differ.
bool are_alike(const LegGeometry& one, const LegGeometry& other) {
  const auto is_near = [](double a, double b) { return std::abs(a - b) <= 0.01 * std::abs(b); };
  return is_near(one.upper_length, other.upper_length) &&
         is_near(one.lower_length, other.lower_length) &&
         is_near(one.upper_mass, other.upper_mass) && is_near(one.lower_mass, other.lower_mass) &&
         is_near(one.wheel_mass, other.wheel_mass) && is_near(one.robot_mass, other.robot_mass);
}

/// The shipped model. Errors: `InputError` for a rate or a robot that it does not serve.
recordings::ParameterModelFile shipped_model_for(const EstimatorSetup& setup) {
  const std::filesystem::path path = find_resource("models/touchdown.npz");
  std::optional<ModelMetadata> metadata;
  recordings::ParameterModelFile file = recordings::read_parameter_model(path, &metadata);
  if (!metadata || setup.transfer) return file;
  const bool is_own_robot = !setup.legs || are_alike(*setup.legs, LegGeometry{});
  try {
    check_use(*metadata,
              {.sample_rate = setup.sample_rate, .robot = is_own_robot ? "" : setup.robot});
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("touchdown_shipped: {}: {} (fit 'touchdown' in this experiment, or "
                    "set `transfer: true` to use it all the same)",
                    path.string(), error.what()));
  }
  return file;
}

Hyperparameter decay() { return fitted_with(around("decay", DecisionFitConfig{}.decay, 10.0)); }
Hyperparameter smoothness() {
  return fitted_with(around("smoothness", EvidenceFitConfig{}.smoothness, 10.0));
}
/// The hyperparameters of the fit, then the thresholds of the decision.
std::vector<Hyperparameter> and_thresholds(std::vector<Hyperparameter> of_fit) {
  of_fit.push_back(between("leave_below", DecisionConfig{}.leave_below, 0.25, 0.8));
  of_fit.push_back(between("return_above", DecisionConfig{}.return_above, 0.8, 0.97));
  return of_fit;
}

}  // namespace

EstimatorEntry decision_network_entry() {
  return {
      .name = "decision_network",
      .title = "Decision network",
      .summary = "Classifies each wheel's load and motion at eight time scales by a small network",
      .sensors = {.hip_torque = true,
                  .knee_torque = true,
                  .wheel_torque = true,
                  .acceleration = true,
                  .joint_position = true,
                  .joint_velocity = true},
      .fit = fit_network,
      .learns_from_segments = true,
      .hyperparameters = and_thresholds({decay()}),
      .make = make_fitted<DecisionNetwork, decision_model_of>};
}

EstimatorEntry evidence_curves_entry() {
  EstimatorEntry entry = decision_network_entry();
  entry.name = "evidence_curves";
  entry.title = "Evidence curves";
  entry.summary =
      "Adds one curve per input of the decision network, as its interpretable counterpart";
  entry.fit = fit_evidence<false>;
  entry.hyperparameters = and_thresholds({smoothness()});
  entry.make = make_fitted<EvidenceCurves, evidence_model_of>;
  return entry;
}

EstimatorEntry evidence_pairs_entry() {
  EstimatorEntry entry = evidence_curves_entry();
  entry.name = "evidence_pairs";
  entry.title = "Evidence curves and pairs";
  entry.summary = "Adds the evidence curves and tables for a few pairs of inputs";
  entry.fit = fit_evidence<true>;
  return entry;
}

EstimatorEntry touchdown_entry() {
  EstimatorEntry entry = decision_network_entry();
  entry.name = "touchdown";
  entry.title = "Touchdown";
  entry.summary = "Averages the logits of the evidence curves and the decision network";
  entry.fit = fit_touchdown;
  entry.hyperparameters = and_thresholds({decay(), smoothness()});
  entry.make = make_fitted<TouchdownEstimator, touchdown_model_of>;
  return entry;
}

EstimatorEntry shipped_touchdown_entry() {
  EstimatorEntry entry = touchdown_entry();
  entry.name = "touchdown_shipped";
  entry.title = "Touchdown, shipped";
  entry.summary =
      "Runs `touchdown` with the shipped model, fitted to Upkie on bent and straight legs";
  entry.fit = nullptr;
  entry.learns_from_segments = false;
  entry.trained_by = "scripts/fit_shipped_model.sh";
  entry.hyperparameters = {};
  entry.require_served = [](const EstimatorSetup& setup) { (void)shipped_model_for(setup); };
  entry.make = [](const EstimatorEntry& /*entry*/,
                  const EstimatorSetup& setup) -> EstimatorPointer {
    return std::make_unique<TouchdownEstimator>(
        touchdown_model_of(shipped_model_for(setup).parameters),
        DecisionConfig{.sample_rate = setup.sample_rate,
                       .geometry = setup.legs.value_or(LegGeometry{})});
  };
  return entry;
}

std::optional<EvidenceModel> evidence_in(const FittedModel& model) {
  if (!model.parameters) return {};
  const std::string& estimator = model.parameters->estimator;
  if (!estimator.starts_with("evidence_") && estimator != "touchdown") return {};
  return evidence_model_of(model.parameters->parameters);
}

}  // namespace touchdown::experiments
