#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/resources.hpp"
#include "estimator/decision/fit.hpp"
#include "estimator/evidence/fit.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/models/parameters.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/fits.hpp"

namespace touchdown::experiments {

namespace {

DecisionConfig config_of(const FitRuns& runs) {
  return {.geometry = legs_of(runs), .servo_load = runs.servo_load};
}

Model fit_network(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_decision_model(labelled, config_of(runs),
                                            {.decay = entry.chosen("decay")}, runs.before_density));
  });
}

Model fit_evidence(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_evidence_curve_sets(labelled, config_of(runs),
                                                 {.smoothness = entry.chosen("smoothness")},
                                                 runs.before_density));
  });
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
Model shipped_model_for(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  const std::filesystem::path path = find_program_file(entry.making.model_file);
  Model model = load_model(path);
  if (!model.metadata || setup.transfer) return model;
  const bool is_own_robot = !setup.legs || are_alike(*setup.legs, LegGeometry{});
  try {
    check_use(*model.metadata,
              {.sample_rate = setup.sample_rate, .robot = is_own_robot ? "" : setup.robot});
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: {}: {} (fit 'evidence_curves' in this experiment, or set "
                    "`transfer: true` to use it all the same)",
                    entry.name, path.string(), error.what()));
  }
  return model;
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

std::unique_ptr<ContactEstimator> make_shipped(const EstimatorEntry& entry,
                                               const EstimatorSetup& setup) {
  const Model model = shipped_model_for(entry, setup);
  return make_with(model, {.estimator = "evidence_curves",
                           .sample_rate = setup.sample_rate,
                           .configuration = model.metadata.value_or(ModelMetadata{}).configuration,
                           .geometry = setup.legs.value_or(LegGeometry{})});
}

EstimatorEntry shipped_entry(const char* name, const char* title, EstimatorEntry entry) {
  entry.name = name;
  entry.title = title;
  entry.summary = fmt::format(
      "Runs the shipped model {}, fitted to Upkie on bent and straight legs", shipped_file(name));
  entry.reason += ", without labels";
  entry.hyperparameters = {};
  entry.fitting = {.trained_by = "scripts/fit_shipped_model.sh"};
  entry.making = {.model_file = shipped_file(name),
                  .by_step = make_shipped,
                  .require_served = [](const EstimatorEntry& own, const EstimatorSetup& setup) {
                    (void)shipped_model_for(own, setup);
                  }};
  return entry;
}

/// A small network with interpretable input features (estimator/decision).
EstimatorEntry decision_network_entry() {
  return {
      .name = "decision_network",
      .title = "Decision network",
      .summary = "Classifies each wheel's load and motion at eight time scales by a small network",
      .reason = "reference: what the transparency of evidence curves costs",
      .sensors = all_sensors,
      .knows = {.geometry = true, .mass = true, .targets = true},
      .hyperparameters = and_thresholds({decay()}, network_point),
      .fitting = {.fit = fit_network, .learns_from_segments = true},
      .making = {.by_step = make_of_model}};
}

}  // namespace

const char* shipped_file(std::string_view estimator) {
  return estimator == "shipped_quiet" ? "models/evidence_curves_quiet.npz"
                                      : "models/evidence_curves.npz";
}

EstimatorEntry evidence_curves_entry() {
  EstimatorEntry entry = decision_network_entry();
  entry.name = "evidence_curves";
  entry.title = "Evidence curves, own fit";
  entry.summary = "Adds up one curve of evidence for each of the wheel's loads and motions";
  entry.reason = "accuracy and transparency";
  entry.fitting.fit = fit_evidence;
  entry.hyperparameters = and_thresholds({smoothness()});
  return entry;
}

std::vector<EstimatorEntry> evidence_entries() {
  const EstimatorEntry balanced = evidence_curves_entry();
  const EstimatorEntry quiet = at_quiet_point(balanced);
  return {decision_network_entry(), balanced, quiet,
          shipped_entry("shipped", "Evidence curves, shipped", balanced),
          shipped_entry("shipped_quiet", "Evidence curves, shipped, quiet", quiet)};
}

std::optional<EvidenceCurveSets> evidence_in(const Model& model) {
  const auto name = model.arrays.find(std::string(estimator_array));
  if (name == model.arrays.end()) return {};
  if (!text_of_array(name->second, name->first).starts_with("evidence_curves")) return {};
  return evidence_curve_sets_of(parameters_of(model.arrays));
}

}  // namespace touchdown::experiments
