#include "experiments/studies/ablation/config.hpp"

#include <algorithm>

#include "experiments/config/experiment_yaml.hpp"
#include "experiments/studies/ablation/estimators.hpp"

namespace touchdown::experiments {

static void describe(Fields& fields, AblationConfig& config, const Experiment& experiment) {
  const std::vector<std::string>& estimators = experiment.estimators;
  constexpr const char* one_of_them = "one of the experiment's estimators";
  if (fields.reading()) config = {estimators.front(), estimators.back()};
  fields.choose("from", estimators, config.from)
      .type(one_of_them)
      .fallback("the first one")
      .doc("First estimator of the row.");
  fields.choose("to", estimators, config.to)
      .type(one_of_them)
      .fallback("the last one")
      .doc("Last estimator of the row.");
  fields.finish();
  fields.check(steps_of(config, estimators).size() >= 2, "to",
               "expected an estimator after the first one of the row");
}

std::vector<std::string> steps_of(const AblationConfig& config,
                                  const std::vector<std::string>& estimators) {
  const auto first = std::find(estimators.begin(), estimators.end(), config.from);
  const auto last = std::find(first, estimators.end(), config.to);
  if (last == estimators.end()) return {};
  return {first, last + 1};
}

StudySection ablation_section() {
  StudySection section = optional_section<AblationConfig>(
      "ablation", "Each of a row of estimators is compared with the one before it.");
  section.estimators = ablation_estimators;
  return section;
}

}  // namespace touchdown::experiments
