#include "experiments/estimators/fitted_model.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/numerics/number_text.hpp"

namespace touchdown::experiments {

HyperparameterValues hyperparameters_of(const std::vector<std::string>& assignments) {
  HyperparameterValues hyperparameters;
  for (const std::string& one : assignments) {
    const std::size_t equals = std::min(one.find('='), one.size());
    const std::optional<double> value =
        equals < one.size() ? number_of(one.substr(equals + 1)) : std::nullopt;
    if (equals == 0 || !value)
      throw InputError(fmt::format("{}: expected name=number, as in leave_below=0.05", one));
    if (!hyperparameters.emplace(one.substr(0, equals), *value).second)
      throw InputError(fmt::format("{}: '{}' is set twice", one, one.substr(0, equals)));
  }
  return hyperparameters;
}

void put_into(ModelMetadata& metadata, const HyperparameterValues& hyperparameters) {
  for (const auto& [name, value] : hyperparameters) {
    if (metadata.configuration.contains(name)) metadata.configuration[name] = text_of(value);
  }
}

void describe_fit(const std::string& estimator, const FittedTo& fitted_to,
                  const HyperparameterValues& hyperparameters, Model& model) {
  model.metadata = {.estimator = estimator,
                    .sample_rate = fitted_to.sample_rate,
                    .robot = fmt::format("{}", fmt::join(fitted_to.robots, ", ")),
                    .configuration = default_configuration(estimator, fitted_to.sample_rate),
                    .fingerprint = {}};
  put_into(*model.metadata, hyperparameters);
  model.arrays[std::string(provenance_array)] = fitted_to.provenance(estimator);
}

}  // namespace touchdown::experiments
