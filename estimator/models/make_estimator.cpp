#include "estimator/models/make_estimator.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "estimator/bayes/ablation.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "estimator/decision/filter.hpp"
#include "estimator/evidence/filter.hpp"
#include "estimator/models/configuration.hpp"
#include "estimator/models/measurement.hpp"
#include "estimator/models/neural.hpp"
#include "estimator/models/parameters.hpp"
#include "estimator/models/phase.hpp"
#include "estimator/phase/filter.hpp"

namespace touchdown {

namespace {

using Made = std::unique_ptr<ContactEstimator>;

/// The fit that all operating points of evidence curves share.
constexpr std::string_view curves_fit = "evidence_curves";

/// The settings that an estimator is made with.
struct Request {
  ConfigurationText configuration;  ///< of the model's own estimator, at the model's rate
  double fitted_rate = 0.0;         ///< Hz
  double sample_rate = 0.0;         ///< Hz
  std::optional<LegGeometry> geometry;
};

/// How the estimator of this name is made from a model.
struct Recipe {
  std::string_view name;
  std::string_view fit;  ///< name of the estimator with the same fit
  std::function<ConfigurationText(double sample_rate, const LegGeometry& legs, bool servo_load)>
      configuration;
  std::function<Made(const ModelArrays& arrays, const Request& request)> make;
};

template <typename Config>
Config configured(Config config, const Request& request) {
  config.sample_rate = request.sample_rate;
  configure(config, request.configuration);
  if constexpr (requires { config.geometry; }) {
    if (request.geometry) config.geometry = *request.geometry;
  }
  return config;
}

/// The window in the text is one at the model's rate.
BayesFilterConfig configured(BayesFilterConfig config, const Request& request) {
  if (!request.configuration.empty()) {
    config.sample_rate = request.fitted_rate;
    configure(config, request.configuration);
  }
  return at_rate(config, request.sample_rate);
}

template <typename Estimator>
Recipe of_torques(std::string_view name, std::string_view fit, const BayesFilterConfig& config) {
  return {name, fit,
          [config](double rate, const LegGeometry& /*legs*/, bool /*servo_load*/) {
            return text_of(at_rate(config, rate));
          },
          [config](const ModelArrays& arrays, const Request& request) -> Made {
            return std::make_unique<Estimator>(measurement_model_of(arrays),
                                               configured(config, request));
          }};
}

Recipe of_phases(std::string_view name) {
  return {name, name,
          [](double /*rate*/, const LegGeometry& /*legs*/, bool /*servo_load*/) {
            return text_of(PhaseFilterConfig{});
          },
          [](const ModelArrays& arrays, const Request& request) -> Made {
            return std::make_unique<PhaseFilter>(phase_model_of(arrays),
                                                 configured(PhaseFilterConfig{}, request));
          }};
}

template <typename Estimator, typename Config, auto model_of>
Recipe of_parameters(std::string_view name) {
  return {name, name,
          [](double /*rate*/, const LegGeometry& legs, bool /*servo_load*/) {
            return text_of(Config{.geometry = legs});
          },
          [](const ModelArrays& arrays, const Request& request) -> Made {
            return std::make_unique<Estimator>(model_of(parameters_of(arrays)),
                                               configured(Config{}, request));
          }};
}

/// An estimator on the features of loads and motions, at one of its operating points. The fit is
/// the same for all points.
template <typename Estimator, auto model_of>
Recipe of_decisions(std::string_view name, std::string_view fit, const OperatingPoint& point) {
  const DecisionConfig usual{.leave_below = point.leave_below, .return_above = point.return_above};
  return {name, fit,
          [usual](double /*rate*/, const LegGeometry& legs, bool servo_load) {
            DecisionConfig config = usual;
            config.geometry = legs;
            config.servo_load = servo_load;
            return text_of(config);
          },
          [usual](const ModelArrays& arrays, const Request& request) -> Made {
            return std::make_unique<Estimator>(model_of(parameters_of(arrays)),
                                               configured(usual, request));
          }};
}

Recipe of_neural_network() {
  return {"nmn", "nmn",
          [](double /*rate*/, const LegGeometry& /*legs*/, bool /*servo_load*/) {
            return text_of(NeuralEstimatorConfig{});
          },
          [](const ModelArrays& arrays, const Request& request) -> Made {
            return std::make_unique<NeuralEstimator>(
                std::make_shared<const NeuralNetwork>(neural_network_of(arrays)),
                configured(NeuralEstimatorConfig{}, request));
          }};
}

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all = [] {
    const BayesFilterConfig robust = BayesFilterConfig::robust();
    std::vector<Recipe> recipes = {
        of_torques<BayesFilter>("robust", "robust", robust),
        of_torques<BayesFilter>("reference", "reference", BayesFilterConfig::reference()),
        of_torques<BayesFilter>("paper", "paper", BayesFilterConfig::paper()),
        of_torques<BayesFilter>("paper_rms", "paper", BayesFilterConfig::paper_rms()),
        of_torques<MeasurementOnly>("measurement_only", "robust", robust),
        of_phases("phase"),
        of_phases("hmm"),
        of_phases("hmm_without_memory"),
        of_neural_network(),
        of_parameters<ForceKinematics, ForceKinematicsConfig, force_kinematics_model_of>(
            "force_kinematics"),
        of_decisions<DecisionNetwork, decision_model_of>("decision_network", "decision_network",
                                                         network_point),
        of_decisions<EvidenceCurves, evidence_curve_sets_of>("evidence_curves", curves_fit,
                                                             balanced_point),
        of_decisions<EvidenceCurves, evidence_curve_sets_of>("evidence_curves_quiet", curves_fit,
                                                             quiet_point)};
    for (const AblationStep& step : steps_from_paper_to_robust()) {
      const bool shares_fit = step.config.measurement == robust.measurement;
      recipes.push_back(
          of_torques<BayesFilter>(step.name, shares_fit ? "robust" : step.name, step.config));
    }
    return recipes;
  }();
  return all;
}

const Recipe* find_recipe(std::string_view name) {
  const auto found = std::find_if(recipes().begin(), recipes().end(),
                                  [&](const Recipe& each) { return each.name == name; });
  return found == recipes().end() ? nullptr : &*found;
}

/// "a, b, c".
std::string listed(const auto& all, const auto& name_of) {
  std::string names;
  for (const auto& one : all) names.append(names.empty() ? "" : ", ").append(name_of(one));
  return names;
}

const Recipe& recipe(std::string_view name) {
  if (const Recipe* found = find_recipe(name)) return *found;
  throw InputError("no model is fitted for '" + std::string(name) + "': expected one of " +
                   listed(recipes(), [](const Recipe& each) { return each.name; }));
}

/// The metadata that follow from the arrays of a model without any.
ModelMetadata metadata_from_arrays(const ModelArrays& arrays) {
  ModelMetadata metadata;
  const auto has = [&](std::string_view name) { return arrays.contains(std::string(name)); };
  if (has(estimator_array)) {
    const std::string name(estimator_array);
    metadata.estimator = text_of_array(arrays.at(name), name);
  } else if (has("transition")) {
    metadata.estimator = "phase";
    metadata.sample_rate = phase_model_of(arrays).sample_rate;
  } else if (has("gru_input_weight")) {
    metadata.estimator = "nmn";
  }
  return metadata;
}

std::string no_such_member(const std::string& estimator, const std::string& key,
                           const ConfigurationText& known) {
  return "the configuration of '" + estimator + "' has no '" + key + "': expected one of " +
         listed(known, [](const auto& member) { return member.first; });
}

/// The model's own configuration, if it was fitted for this estimator, with `replaced` members. At
/// another operating point, evidence curves keep all of it but their thresholds.
ConfigurationText configuration_for(const ModelMetadata& metadata, const std::string& estimator,
                                    const ConfigurationText& replaced) {
  ConfigurationText configuration;
  if (estimator == metadata.estimator) {
    configuration = metadata.configuration;
  } else if (recipe(estimator).fit == curves_fit) {
    configuration = metadata.configuration;
    configuration.erase("leave_below");
    configuration.erase("return_above");
  }
  if (replaced.empty()) return configuration;
  const ConfigurationText usual = recipe(estimator).configuration(metadata.sample_rate, {}, false);
  if (configuration.empty()) configuration = usual;
  for (const auto& [key, value] : replaced) {
    if (!usual.contains(key) && !is_signal_bound(key))
      throw InputError(no_such_member(estimator, key, usual));
    configuration[key] = value;
  }
  return configuration;
}

}  // namespace

ConfigurationText default_configuration(std::string_view estimator, double sample_rate,
                                        const LegGeometry& legs, bool servo_load) {
  return recipe(estimator).configuration(sample_rate, legs, servo_load);
}

bool makes_estimator(std::string_view name) { return find_recipe(name) != nullptr; }

bool share_fit(std::string_view estimator, std::string_view other) {
  return estimator == other || recipe(estimator).fit == recipe(other).fit;
}

ModelMetadata metadata_for(const ModelArrays& arrays, const ModelUse& use) {
  check_sample_rate(use);
  const std::optional<ModelMetadata> written = metadata_of(arrays);
  ModelMetadata metadata = written ? *written : metadata_from_arrays(arrays);
  if (metadata.estimator.empty()) metadata.estimator = use.estimator;
  if (metadata.sample_rate == 0.0) metadata.sample_rate = use.sample_rate;
  if (metadata.estimator.empty() || !(metadata.sample_rate > 0.0)) {
    const char* const what = !metadata.estimator.empty() ? "its sample_rate (Hz)"
                             : metadata.sample_rate > 0.0
                                 ? "the estimator that it was fitted for"
                                 : "the estimator that it was fitted for, and its sample_rate (Hz)";
    throw InputError(std::string("has no metadata, being older or from another program: name ") +
                     what);
  }
  if (!use.estimator.empty() && !share_fit(metadata.estimator, use.estimator)) {
    throw InputError("was fitted for '" + metadata.estimator + "', which '" + use.estimator +
                     "' cannot use");
  }
  check_use(metadata, use);
  return metadata;
}

std::unique_ptr<ContactEstimator> make_estimator(const ModelArrays& arrays, const ModelUse& use) {
  const ModelMetadata metadata = metadata_for(arrays, use);
  const std::string& name = use.estimator.empty() ? metadata.estimator : use.estimator;
  const bool is_fitted_rate =
      use.sample_rate == 0.0 || is_same_rate(use.sample_rate, metadata.sample_rate);
  Made made = recipe(name).make(
      arrays, {configuration_for(metadata, name, use.configuration), metadata.sample_rate,
               is_fitted_rate ? metadata.sample_rate : use.sample_rate, use.geometry});
  ConfigurationText bounds = use.configuration;  // of the robot, whichever estimator it runs
  bounds.insert(metadata.configuration.begin(), metadata.configuration.end());
  made->limit_signals(signal_bounds_of(bounds));
  return made;
}

}  // namespace touchdown
