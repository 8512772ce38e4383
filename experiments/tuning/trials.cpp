#include "experiments/tuning/trials.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/fingerprint.hpp"
#include "core/random.hpp"

namespace touchdown::experiments {

namespace {

double drawn(const Hyperparameter& choice, double uniform) {
  const double span = choice.highest - choice.lowest;
  switch (choice.scale) {
    case Hyperparameter::Scale::whole:
      return choice.lowest + std::floor(uniform * (span + 1.0));
    case Hyperparameter::Scale::by_ratio:
      return choice.lowest * std::pow(choice.highest / choice.lowest, uniform);
    case Hyperparameter::Scale::even:
      break;
  }
  return choice.lowest + uniform * span;
}

double with_three_digits(double number) { return std::stod(fmt::format("{:.3g}", number)); }

}  // namespace

std::vector<HyperparameterValues> trial_hyperparameters(const EstimatorEntry& entry, std::uint64_t seed,
                                       int trials) {
  if (entry.hyperparameters.empty()) return {};
  const std::uint64_t stream = Fingerprint().add("tuning").add(entry.name).value();
  std::vector<HyperparameterValues> all(static_cast<std::size_t>(trials));
  for (std::size_t trial = 0; trial < all.size(); ++trial) {
    for (std::size_t i = 0; i < entry.hyperparameters.size(); ++i) {
      const Hyperparameter& choice = entry.hyperparameters[i];
      const double uniform = uniform01(seed, stream + i, trial);
      all[trial][choice.name] =
          trial == 0 ? choice.value : with_three_digits(drawn(choice, uniform));
    }
  }
  return all;
}

}  // namespace touchdown::experiments
