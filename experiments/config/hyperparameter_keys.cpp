#include "experiments/config/hyperparameter_keys.hpp"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "core/resources.hpp"
#include "experiments/estimators/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

using HyperparametersByEstimator = std::map<std::string, HyperparameterValues>;

/// The section of each estimator.
void describe_estimators(Fields& all, HyperparametersByEstimator& values,
                         const Experiment& experiment) {
  for (const std::string& name : all.documenting() ? estimator_names() : experiment.estimators) {
    all.know(name);
    if (!all.present(name, values.contains(name))) continue;
    if (all.documenting() && estimator_entry(name).hyperparameters.empty()) continue;
    HyperparameterValues& hyperparameters = values[name];
    const auto describe_own = [&](Fields& own) {
      for (const Hyperparameter& one :
           estimator_entry(name, experiment.external_estimators).hyperparameters) {
        own.know(one.name);
        if (!own.present(one.name, hyperparameters.contains(one.name))) continue;
        own(one.name, hyperparameters[one.name])
            .fallback(value_text(YAML::Node(one.value)))
            .doc(fmt::format("Tuning draws it from {:g} to {:g}.", one.lowest, one.highest));
      }
    };
    all.within(name, describe_own).doc("Hyperparameters of this estimator.");
  }
}

/// Reads the values that a tuning chose and wrote, by engine. Those of other engines and estimators
/// than the experiment's are left out.
void read_hyperparameters(const std::string& file, Experiment& experiment) {
  Fields fields(YamlDocument::load(find_resource(file)));
  fields.know("manifest");
  for (const std::string& engine : simulators::simulator_names()) {
    fields.know(engine);
    const auto& own = experiment.simulators;
    if (std::find(own.begin(), own.end(), engine) == own.end()) continue;
    if (!fields.present(engine, false)) continue;
    fields.within(engine, [&](Fields& of_engine) {
      for (const std::string& name : estimator_names()) of_engine.know(name);
      describe_estimators(of_engine, experiment.engine_hyperparameters[engine], experiment);
    });
  }
  fields.finish();
}

}  // namespace

void describe_hyperparameters(Fields& fields, Experiment& experiment) {
  constexpr const char* key = "hyperparameters";
  fields.know(key);
  auto& of_engines = experiment.engine_hyperparameters;
  if (!fields.present(key, !experiment.hyperparameters.empty() || !of_engines.empty())) return;
  const auto describe_all = [&](Fields& all) {
    std::string file;
    all.know("tuned");
    if (all.present("tuned", false) || all.documenting()) {
      all("tuned", file)
          .fallback("none")
          .doc("Values by engine that `fit.tuning` chose: `tables/hyperparameters.yaml` of a run.");
      if (!all.documenting()) all.check("tuned", [&] { read_hyperparameters(file, experiment); });
    }
    for (const std::string& engine : experiment.simulators) {
      all.know(engine);
      const bool is_given = of_engines.contains(engine);
      if (all.documenting() || !all.present(engine, is_given)) continue;
      all.within(engine, [&](Fields& of_engine) {
        describe_estimators(of_engine, of_engines[engine], experiment);
      });
    }
    describe_estimators(all, experiment.hyperparameters, experiment);
  };
  fields.within(key, describe_all)
      .fallback("none")
      .doc("Values instead of the estimators' defaults, also by engine; not beside `fit.tuning`.");
  fields.check(!experiment.tuning, key, "expected no fit.tuning beside it, which chooses them");
}

}  // namespace touchdown::experiments
