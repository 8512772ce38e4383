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
#include "estimator/models/configuration.hpp"
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

FittedModel fit_evidence(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_evidence_curve_sets(labelled, config_of(runs),
                                                 {.smoothness = entry.chosen("smoothness")},
                                                 runs.before_density));
  });
}

EstimatorPointer make_network(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return std::make_unique<DecisionNetwork>(
      decision_model_of(setup.model->parameters->parameters),
      configured(DecisionConfig{.sample_rate = setup.sample_rate,
                                .leave_below = entry.chosen("leave_below"),
                                .return_above = entry.chosen("return_above")},
                 entry, setup));
}

/// All operating points share the fit: a model of another one gives all settings but thresholds.
EstimatorPointer make_curves(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  DecisionConfig config{.sample_rate = setup.sample_rate};
  const std::optional<ModelMetadata>& metadata = setup.model->metadata;
  if (metadata) configure(config, metadata->configuration);
  config.sample_rate = setup.sample_rate;
  if (!metadata || metadata->estimator != entry.name) {
    config.leave_below = entry.chosen("leave_below");
    config.return_above = entry.chosen("return_above");
  }
  if (setup.legs) config.geometry = *setup.legs;
  return std::make_unique<EvidenceCurves>(
      evidence_curve_sets_of(setup.model->parameters->parameters), config);
}

/// Whether both legs, and the robots that they carry, are the same to a percent. Rotors may differ.
bool are_alike(const LegGeometry& one, const LegGeometry& other) {
  const auto is_near = [](double a, double b) { return std::abs(a - b) <= 0.01 * std::abs(b); };
  return is_near(one.upper_length, other.upper_length) &&
         is_near(one.lower_length, other.lower_length) &&
         is_near(one.upper_mass, other.upper_mass) && is_near(one.lower_mass, other.lower_mass) &&
         is_near(one.wheel_mass, other.wheel_mass) && is_near(one.robot_mass, other.robot_mass);
}

/// A shipped model. Errors: `InputError` for a rate or a robot that it does not serve.
recordings::ParameterModelFile shipped_model_for(const EstimatorEntry& entry,
                                                 const EstimatorSetup& setup,
                                                 std::optional<ModelMetadata>& metadata) {
  const std::filesystem::path path = find_resource(shipped_file(entry.name));
  recordings::ParameterModelFile file = recordings::read_parameter_model(path, &metadata);
  if (!metadata || setup.transfer) return file;
  const bool is_own_robot = !setup.legs || are_alike(*setup.legs, LegGeometry{});
  try {
    check_use(*metadata,
              {.sample_rate = setup.sample_rate, .robot = is_own_robot ? "" : setup.robot});
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: {}: {} (fit 'evidence_curves' in this experiment, or set "
                    "`transfer: true` to use it all the same)",
                    entry.name, path.string(), error.what()));
  }
  return file;
}

Hyperparameter decay() { return fitted_with(around("decay", DecisionFitConfig{}.decay, 10.0)); }
Hyperparameter smoothness() {
  return fitted_with(around("smoothness", EvidenceFitConfig{}.smoothness, 10.0));
}
/// The hyperparameters of the fit, then the thresholds of the decision.
std::vector<Hyperparameter> and_thresholds(std::vector<Hyperparameter> of_fit,
                                           const OperatingPoint& point = balanced_point) {
  of_fit.push_back(between("leave_below", point.leave_below, 0.1, 0.9));
  // Above any usual first threshold.
  const double lowest = 0.5 * (point.leave_below + point.return_above);
  of_fit.push_back(between("return_above", point.return_above, lowest, 0.995));
  return of_fit;
}

/// The estimator at another operating point, with the same fit.
EstimatorEntry at_quiet_point(EstimatorEntry entry) {
  entry.name += "_quiet";
  entry.title += ", quiet";
  entry.summary += ", with few false takeoffs";
  entry.reason = "flicker: few false takeoffs";
  entry.hyperparameters = and_thresholds({smoothness()}, quiet_point);
  return entry;
}

EstimatorEntry shipped_entry(const char* name, const EstimatorEntry& fitted) {
  EstimatorEntry entry = fitted;
  entry.name = name;
  entry.title += ", shipped";
  entry.summary = fmt::format(
      "Runs the shipped model {}, fitted to Upkie on bent and straight legs", shipped_file(name));
  entry.reason += ", without labels";
  entry.fit = nullptr;
  entry.learns_from_segments = false;
  entry.trained_by = "scripts/fit_shipped_model.sh";
  entry.hyperparameters = {};
  entry.require_served = [](const EstimatorEntry& own, const EstimatorSetup& setup) {
    std::optional<ModelMetadata> metadata;
    (void)shipped_model_for(own, setup, metadata);
  };
  entry.make = [](const EstimatorEntry& own, const EstimatorSetup& setup) -> EstimatorPointer {
    std::optional<ModelMetadata> metadata;
    const recordings::ParameterModelFile file = shipped_model_for(own, setup, metadata);
    DecisionConfig config;
    if (metadata) configure(config, metadata->configuration);
    config.sample_rate = setup.sample_rate;
    config.geometry = setup.legs.value_or(LegGeometry{});
    return std::make_unique<EvidenceCurves>(evidence_curve_sets_of(file.parameters), config);
  };
  return entry;
}

}  // namespace

const char* shipped_file(std::string_view estimator) {
  return estimator == "shipped_quiet" ? "models/evidence_curves_quiet.npz"
                                      : "models/evidence_curves.npz";
}

EstimatorEntry decision_network_entry() {
  return {
      .name = "decision_network",
      .title = "Decision network",
      .summary = "Classifies each wheel's load and motion at eight time scales by a small network",
      .reason = "reference: what the transparency of evidence curves costs",
      .sensors = {.hip_torque = true,
                  .knee_torque = true,
                  .wheel_torque = true,
                  .acceleration = true,
                  .joint_position = true,
                  .joint_velocity = true},
      .knows = {.geometry = true, .mass = true, .targets = true},
      .fit = fit_network,
      .learns_from_segments = true,
      .hyperparameters = and_thresholds({decay()}, network_point),
      .make = make_network};
}

EstimatorEntry evidence_curves_entry() {
  EstimatorEntry entry = decision_network_entry();
  entry.name = "evidence_curves";
  entry.title = "Evidence curves";
  entry.summary = "Adds up one curve of evidence for each of the wheel's loads and motions";
  entry.reason = "accuracy and transparency";
  entry.fit = fit_evidence;
  entry.hyperparameters = and_thresholds({smoothness()});
  entry.make = make_curves;
  return entry;
}

EstimatorEntry quiet_evidence_curves_entry() { return at_quiet_point(evidence_curves_entry()); }

EstimatorEntry shipped_curves_entry() { return shipped_entry("shipped", evidence_curves_entry()); }

EstimatorEntry quiet_shipped_curves_entry() {
  return shipped_entry("shipped_quiet", quiet_evidence_curves_entry());
}

std::optional<EvidenceCurveSets> evidence_in(const FittedModel& model) {
  if (!model.parameters) return {};
  const std::string& estimator = model.parameters->estimator;
  if (!estimator.starts_with("evidence_curves")) return {};
  return evidence_curve_sets_of(model.parameters->parameters);
}

}  // namespace touchdown::experiments
