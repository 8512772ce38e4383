#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/signals/run_signals.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

class BoostedEntry : public ::testing::TestWithParam<const char*> {};

TEST_P(BoostedEntry, RefusesInvalidTrees) {
  const EstimatorEntry entry = estimator_entry(GetParam());
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const Model fitted = entry.fit({.whole = {&run}});
  const auto refused = [&](const char* name, const auto& change) {
    Model model = fitted;
    ModelArray& array = model.arrays.at(name);
    change(array.data);
    array.shape = {array.data.size()};
    EXPECT_THROW(entry.make({.model = &model}), InputError) << name;
  };
  refused("leaf", [](std::vector<double>& values) { values.pop_back(); });
  refused("feature", [](std::vector<double>& values) { values[0] = 1e9; });
  refused("feature", [](std::vector<double>& values) { values[0] = -1.0; });
  refused("depth", [](std::vector<double>& values) { values[0] = 1e300; });
  refused("trees", [](std::vector<double>& values) { values[0] = -5.0; });
  refused("threshold", [](std::vector<double>& values) { values[3] = 1e300; });
}

/// The run with a tracking error of the knees that shows contact, and no other sign of it.
RunSignals shown_by_targets(std::int64_t seed) {
  RunSignals run = synthetic_run(seed, 2000);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    Signals& signals = run.signals[k];
    const bool in_contact = k / 250 % 2 == 0;
    signals.vertical_acceleration = 0.01 * static_cast<double>(k % 7);
    for (std::size_t side = 0; side < 2; ++side) {
      run.contact[side][k] = in_contact ? 1 : 0;
      const double sign = side == 0 ? 1.0 : -1.0;
      LegSignals& leg = signals.leg[side];
      const double chatter = 0.01 * static_cast<double>(k % 5);
      leg.hip = {0.5 * sign, chatter, 0.3 * chatter};
      leg.knee = {-1.0 * sign, chatter, 0.3 * chatter};
      leg.wheel = {0.01 * static_cast<double>(k), 1.0, 0.3 * chatter};
      signals.target[side].hip = {0.5 * sign, 0.0, 0.0, 40.0, 0.0};
      signals.target[side].knee = {sign * (in_contact ? -0.95 : -1.0), 0.0, 0.0, 40.0, 0.0};
    }
  }
  return run;
}

TEST_P(BoostedEntry, UsesTargetsIfItsFitDoes) {
  const EstimatorEntry entry = estimator_entry(GetParam());
  const RunSignals run = shown_by_targets(1'000'000);
  const RunSignals other = shown_by_targets(3);
  const auto right = [&](bool servo_load) {
    const Model model = entry.fit({.whole = {&run}, .servo_load = servo_load});
    const auto decided = decide(*entry.make({.model = &model}), other, noise_run(other, {}), {});
    std::size_t count = 0;
    for (std::size_t k = 0; k < other.steps(); ++k) {
      count += decided[0][k] == other.contact[0][k] ? 1U : 0U;
    }
    return static_cast<double>(count) / static_cast<double>(other.steps());
  };
  EXPECT_GT(right(true), 0.95);
  EXPECT_LT(right(false), 0.7);
}

INSTANTIATE_TEST_SUITE_P(Inputs, BoostedEntry,
                         ::testing::Values("boosted_channels", "boosted_signals"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace touchdown::experiments
