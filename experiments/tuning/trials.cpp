#include "experiments/tuning/trials.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/fingerprint.hpp"
#include "core/random.hpp"

namespace touchdown::experiments {

namespace {

double drawn(const Choice& choice, double uniform) {
  const double span = choice.highest - choice.lowest;
  switch (choice.scale) {
    case Choice::Scale::whole:
      return choice.lowest + std::floor(uniform * (span + 1.0));
    case Choice::Scale::by_ratio:
      return choice.lowest * std::pow(choice.highest / choice.lowest, uniform);
    case Choice::Scale::even:
      break;
  }
  return choice.lowest + uniform * span;
}

double with_three_digits(double number) { return std::stod(fmt::format("{:.3g}", number)); }

}  // namespace

std::vector<Constants> trial_constants(const EstimatorEntry& entry, std::uint64_t seed,
                                       int trials) {
  if (entry.choices.empty()) return {};
  const std::uint64_t stream = Fingerprint().add("tuning").add(entry.name).value();
  std::vector<Constants> all(static_cast<std::size_t>(trials));
  for (std::size_t trial = 0; trial < all.size(); ++trial) {
    for (std::size_t i = 0; i < entry.choices.size(); ++i) {
      const Choice& choice = entry.choices[i];
      const double uniform = uniform01(seed, stream + i, trial);
      all[trial][choice.name] =
          trial == 0 ? choice.value : with_three_digits(drawn(choice, uniform));
    }
  }
  return all;
}

}  // namespace touchdown::experiments
