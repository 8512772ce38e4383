#include "experiments/cross_simulator_sensitivity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/table.hpp"

namespace touchdown {

namespace {

/// The number under a dotted key, list items by number; NaN if there is none.
double value_at(YAML::Node node, std::string_view key) {
  while (!key.empty() && node.IsDefined()) {
    const std::size_t dot = std::min(key.find('.'), key.size());
    const std::string part(key.substr(0, dot));
    key.remove_prefix(std::min(dot + 1, key.size()));
    if (node.IsSequence()) {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
      if (error != std::errc{} || index >= node.size()) break;
      node.reset(node[index]);
    } else if (node.IsMap() && node[part].IsDefined()) {
      node.reset(node[part]);
    } else {
      break;
    }
  }
  if (!key.empty() || !node.IsScalar()) return std::numeric_limits<double>::quiet_NaN();
  return node.as<double>(std::numeric_limits<double>::quiet_NaN());
}

Scenario varied(const NamedScenario& named, const Factor& factor, double value) {
  YamlDocument document = YamlDocument::parse(to_yaml(named.scenario), named.file);
  document.override_value(fmt::format("{}={}", factor.key, exact(value)));
  return scenario_from_yaml(document);
}

double nominal_of(const NamedScenario& named, const Factor& factor) {
  return value_at(YAML::Load(to_yaml(named.scenario)), factor.key);
}

}  // namespace

std::vector<Variation> plan_variations(const CrossSimulator& config,
                                       const std::vector<NamedScenario>& scenarios) {
  const Experiment& experiment = config.experiment;
  const NamedScenario& named =
      *std::find_if(scenarios.begin(), scenarios.end(), [&](const NamedScenario& candidate) {
        return candidate.file == experiment.test.scenarios.front();
      });
  std::vector<Variation> variations;
  for (std::size_t f = 0; f < config.factors.size(); ++f) {
    const Factor& factor = config.factors[f];
    const double nominal = nominal_of(named, factor);
    if (std::isnan(nominal)) {
      throw InputError(fmt::format("cross_simulator.sensitivity.factors.{}: {} has no number at {}",
                                   f, named.file, factor.key));
    }
    std::set<double> values(factor.values.begin(), factor.values.end());
    values.insert(nominal);
    for (const std::string& simulator : factor.simulators) {
      for (const double value : values) {
        Variation variation{factor.name, value, nominal, simulator, {}};
        for (int i = 0; value != nominal && i < config.sensitivity_runs; ++i) {
          try {
            const Scenario scenario = varied(named, factor, value);
            variation.plan.push_back(
                {RunRole::test, simulator,
                 experiment.test.perturbed ? perturbed(scenario, experiment.seed, i) : scenario, i,
                 fmt::format("{}_{}_factor_{}_{}_{:03}.mpack", simulator, scenario.name, f,
                             exact(value), i)});
          } catch (const InputError& error) {
            throw InputError(fmt::format("cross_simulator.sensitivity.factors.{}: {}={}: {}", f,
                                         factor.key, exact(value), error.what()));
          }
        }
        variations.push_back(std::move(variation));
      }
    }
  }
  return variations;
}

std::vector<Sensitivity> sensitivity(const Experiment& experiment, const Variation& variation,
                                     const std::vector<const PlayedRun*>& runs,
                                     const FittedModels& models, const SweepProgress& progress) {
  std::vector<const HeardRun*> heard;
  for (const PlayedRun* run : runs) {
    if (!is_failure(run->report.outcome)) heard.push_back(&run->heard);
  }
  std::vector<Condition> conditions = own_engine_conditions(experiment);
  std::erase_if(conditions, [&](const Condition& condition) {
    return condition.test_simulator != variation.simulator;
  });
  const std::vector<ConditionCounts> counts =
      sweep(experiment, conditions, {experiment.highlights.front()}, heard, models, progress);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Sensitivity> result;
  for (const ConditionCounts& count : counts) {
    Sensitivity row{variation.factor,           variation.value,           variation.nominal,
                    variation.simulator,        count.condition.estimator, heard.size(),
                    runs.size() - heard.size(), Interval{nan, nan, nan}};
    if (!heard.empty()) {
      row.success =
          bootstrap<Classification>(count.samples.front(),
                                    {[](const Classification& sum) { return sum.success(); }},
                                    experiment.intervals.bootstrap)
              .front();
    }
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace touchdown
