#include "estimator/models/make_estimator.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "estimator/bayes/ablation.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "estimator/force/load_filter.hpp"
#include "estimator/models/configuration.hpp"

namespace touchdown {

namespace {

using Made = std::unique_ptr<ContactEstimator>;

/// How the estimator of this name is made from a model.
struct Recipe {
  std::string_view name;
  std::string_view fit;  ///< name of the estimator with the same fit
  std::function<ConfigurationText(double sample_rate)> configuration;
  std::function<Made(const Model& model, const EstimatorSettings& settings)> make;
  std::function<void(const ConfigurationText& text)> check;
};

/// Errors: `InputError` for a model without a grid.
MeasurementModel grid_of(const Model& model) {
  return model.grid ? *model.grid : measurement_model_of(model.arrays);
}

std::shared_ptr<const NeuralNetwork> network_of(const Model& model) {
  return std::make_shared<const NeuralNetwork>(neural_network_of(model.arrays));
}

template <typename Config>
Config configured(Config config, const EstimatorSettings& settings) {
  config.sample_rate = settings.sample_rate;
  configure(config, settings.configuration);
  return config;
}

/// The window in the text is one at the model's rate.
BayesFilterConfig configured(BayesFilterConfig config, const EstimatorSettings& settings) {
  if (!settings.configuration.empty()) {
    config.sample_rate = settings.configured_rate;
    configure(config, settings.configuration);
  }
  return at_rate(config, settings.sample_rate);
}

/// An estimator of a model's numbers, which `numbers_of` reads if there are any. `usual` is its
/// configuration on Upkie at the library's rate.
template <typename Estimator, auto... numbers_of, typename Config>
Recipe recipe_of(std::string_view name, std::string_view fit, const Config& usual) {
  return {name, fit,
          [usual]([[maybe_unused]] double rate) {
            if constexpr (requires { usual.transition; }) return text_of(at_rate(usual, rate));
            return text_of(usual);
          },
          [usual]([[maybe_unused]] const Model& model, const EstimatorSettings& settings) -> Made {
            return std::make_unique<Estimator>(numbers_of(model)..., configured(usual, settings));
          },
          [usual](const ConfigurationText& text) {
            Config config = usual;
            configure(config, text);
            check_members(config);
          }};
}

template <typename Estimator>
Recipe of_torques(std::string_view name, std::string_view fit, const BayesFilterConfig& config) {
  return recipe_of<Estimator, grid_of>(name, fit, config);
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
        recipe_of<NeuralEstimator, network_of>("nmn", "nmn", NeuralEstimatorConfig{}),
        // It has nothing to fit: its model is the robot's geometry, in the metadata.
        recipe_of<LoadFilter>(load_filter_name, load_filter_name, LoadFilterConfig{})};
    for (const AblationStep& step : steps_from_paper_to_robust()) {
      const bool shares_fit = step.config.measurement == robust.measurement;
      recipes.push_back(
          of_torques<BayesFilter>(step.name, shares_fit ? "robust" : step.name, step.config));
    }
    return recipes;
  }();
  return all;
}

/// "a, b, c".
std::string listed(const auto& all, const auto& name_of) {
  std::string names;
  for (const auto& one : all) names.append(names.empty() ? "" : ", ").append(name_of(one));
  return names;
}

const Recipe& recipe(std::string_view name) {
  const auto found = std::ranges::find(recipes(), name, &Recipe::name);
  if (found != recipes().end()) return *found;
  throw InputError("no model is fitted for '" + std::string(name) + "': expected one of " +
                   listed(recipes(), [](const Recipe& each) { return each.name; }));
}

std::string no_such_member(const std::string& estimator, const std::string& key,
                           const ConfigurationText& known) {
  std::vector<std::string> names;
  for (const auto& [name, value] : known) names.push_back(name);
  std::string near = did_you_mean(key, names);
  if (near.empty()) near = ": expected one of " + listed(names, std::identity());
  return "the configuration of '" + estimator + "' has no '" + key + "'" + near;
}

/// The model's own configuration, if it was fitted for this estimator, with `replaced` members.
ConfigurationText configuration_for(const ModelMetadata& metadata, const std::string& estimator,
                                    const ConfigurationText& replaced) {
  ConfigurationText configuration;
  if (estimator == metadata.estimator) configuration = metadata.configuration;
  if (replaced.empty()) return configuration;
  const ConfigurationText usual = recipe(estimator).configuration(metadata.sample_rate);
  if (configuration.empty()) configuration = usual;
  for (const auto& [key, value] : replaced) {
    if (!usual.contains(key) && !is_signal_bound(key))
      throw InputError(no_such_member(estimator, key, usual));
    configuration[key] = value;
  }
  return configuration;
}

}  // namespace

ModelArrays arrays_of(std::span<const CompiledArray> model) {
  ModelArrays arrays;
  for (const CompiledArray& from : model) {
    ModelArray& array = arrays[from.name];
    array.shape = {from.rows};
    if (from.columns > 0) array.shape.push_back(from.columns);
    const std::size_t count = array.rows() * array.columns();
    if (from.text != nullptr) {
      array = array_of_text({from.text, count});
    } else if (from.floats != nullptr) {
      array.data.assign(from.floats, from.floats + count);
    } else {
      array.data.assign(from.doubles, from.doubles + count);
    }
  }
  return arrays;
}

Model load_filter_model(const LegGeometry& legs, double sample_rate, const std::string& robot) {
  const std::string name(load_filter_name);
  Model model{.arrays = {{std::string(estimator_array), array_of_text(name)}}};
  model.metadata = ModelMetadata{.estimator = name,
                                 .sample_rate = sample_rate,
                                 .robot = robot,
                                 .configuration = text_of(LoadFilterConfig{.geometry = legs}),
                                 .fingerprint = {}};
  return model_of(arrays_of(model));  // with the fingerprint
}

std::unique_ptr<ContactEstimator> make_estimator(std::span<const CompiledArray> model,
                                                 const ModelUse& use) {
  return make_estimator(arrays_of(model), use);
}

ConfigurationText default_configuration(std::string_view estimator, double sample_rate) {
  return recipe(estimator).configuration(sample_rate);
}

void check_configuration(std::string_view estimator, const ConfigurationText& text) {
  const auto found = std::ranges::find(recipes(), estimator, &Recipe::name);
  if (found != recipes().end()) found->check(text);
}

bool share_fit(std::string_view estimator, std::string_view other) {
  return estimator == other || recipe(estimator).fit == recipe(other).fit;
}

ModelMetadata metadata_for(const Model& model, const ModelUse& use) {
  check_sample_rate(use);
  ModelMetadata metadata = model.metadata.value_or(ModelMetadata{.estimator = estimator_of(model),
                                                                 .sample_rate = 0.0,
                                                                 .robot = {},
                                                                 .configuration = {},
                                                                 .fingerprint = {}});
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

std::unique_ptr<ContactEstimator> make_with(const Model& model, const EstimatorSettings& settings) {
  return recipe(settings.estimator).make(model, settings);
}

std::unique_ptr<ContactEstimator> make_estimator(const Model& model, const ModelUse& use) {
  const ModelMetadata metadata = metadata_for(model, use);
  const std::string& name = use.estimator.empty() ? metadata.estimator : use.estimator;
  const bool is_fitted_rate =
      use.sample_rate == 0.0 || is_same_rate(use.sample_rate, metadata.sample_rate);
  ConfigurationText configuration = configuration_for(metadata, name, use.configuration);
  if (use.geometry && name == load_filter_name) put_into(configuration, *use.geometry);
  Made made =
      make_with(model, {.estimator = name,
                        .sample_rate = is_fitted_rate ? metadata.sample_rate : use.sample_rate,
                        .configuration = std::move(configuration),
                        .configured_rate = metadata.sample_rate});
  ConfigurationText bounds = use.configuration;  // of the robot, whichever estimator it runs
  bounds.insert(metadata.configuration.begin(), metadata.configuration.end());
  made->limit_signals(signal_bounds_of(bounds));
  return made;
}

std::unique_ptr<ContactEstimator> make_estimator(const ModelArrays& arrays, const ModelUse& use) {
  return make_estimator(model_of(arrays), use);
}

Model model_for(Model model, const ModelUse& use) {
  ModelUse any_robot = use;
  if (use.geometry) any_robot.robot.clear();
  ModelMetadata metadata = metadata_for(model, any_robot);
  any_robot.estimator = metadata.estimator;
  make_estimator(model, any_robot);  // fails here rather than on the robot
  if (use.geometry && metadata.estimator != load_filter_name) {
    throw InputError("'" + metadata.estimator +
                     "' uses no kinematics, so legs do not adapt it: fit it to the robot");
  }
  if (metadata.configuration.empty()) {
    metadata.configuration = default_configuration(metadata.estimator, metadata.sample_rate);
  }
  if (use.geometry) put_into(metadata.configuration, *use.geometry);
  for (const auto& [key, value] : use.configuration) metadata.configuration[key] = value;
  if (use.geometry || metadata.robot.empty()) metadata.robot = use.robot;
  model.metadata = std::move(metadata);
  model.metadata = metadata_of(arrays_of(model));  // with the fingerprint
  return model;
}

}  // namespace touchdown
