#include "experiments/tuning/trials.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/fingerprint.hpp"
#include "core/random.hpp"

namespace touchdown::experiments {

namespace {

double drawn(const Hyperparameter& one, double uniform) {
  const double span = one.highest - one.lowest;
  switch (one.scale) {
    case Hyperparameter::Scale::whole:
      return one.lowest + std::floor(uniform * (span + 1.0));
    case Hyperparameter::Scale::by_ratio:
      return one.lowest * std::pow(one.highest / one.lowest, uniform);
    case Hyperparameter::Scale::even:
      break;
  }
  return one.lowest + uniform * span;
}

double with_three_digits(double number) { return std::stod(fmt::format("{:.3g}", number)); }

}  // namespace

std::vector<HyperparameterValues> trial_hyperparameters(const EstimatorEntry& entry,
                                                        std::uint64_t seed, int trials) {
  if (entry.hyperparameters.empty()) return {};
  const std::uint64_t stream = Fingerprint().add("tuning").add(entry.name).value();
  std::vector<HyperparameterValues> all(static_cast<std::size_t>(trials));
  for (std::size_t trial = 0; trial < all.size(); ++trial) {
    for (std::size_t i = 0; i < entry.hyperparameters.size(); ++i) {
      const Hyperparameter& one = entry.hyperparameters[i];
      const double uniform = uniform01(seed, stream + i, trial);
      all[trial][one.name] = trial == 0 ? one.value : with_three_digits(drawn(one, uniform));
    }
  }
  return all;
}

}  // namespace touchdown::experiments
