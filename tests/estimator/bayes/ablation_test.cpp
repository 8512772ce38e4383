#include "estimator/bayes/ablation.hpp"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

using Config = BayesFilterConfig;

/// A group of settings, and how to copy it from another configuration.
struct Setting {
  const char* name;
  void (*copy)(Config& to, const Config& from);
};

/// Listed here independently, by the fields, and not by the changes of the ablation.
const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = {
      {"sample rate", [](Config& to, const Config& from) { to.sample_rate = from.sample_rate; }},
      {"sign of torques",
       [](Config& to, const Config& from) {
         to.measurement.torque.sign = from.measurement.torque.sign;
       }},
      {"low-pass of torques",
       [](Config& to, const Config& from) {
         to.measurement.torque.low_pass = from.measurement.torque.low_pass;
       }},
      {"grid",
       [](Config& to, const Config& from) {
         to.measurement.fit.knee_count = from.measurement.fit.knee_count;
         to.measurement.fit.wheel_count = from.measurement.fit.wheel_count;
         to.measurement.fit.knee_range = from.measurement.fit.knee_range;
         to.measurement.fit.wheel_range = from.measurement.fit.wheel_range;
       }},
      {"bandwidth",
       [](Config& to, const Config& from) {
         to.measurement.fit.bandwidth_floor = from.measurement.fit.bandwidth_floor;
         to.measurement.fit.bandwidth = from.measurement.fit.bandwidth;
       }},
      {"noise of torques",
       [](Config& to, const Config& from) { to.measurement.noise = from.measurement.noise; }},
      {"likelihood floor",
       [](Config& to, const Config& from) {
         to.measurement.contact_floor = from.measurement.contact_floor;
         to.measurement.no_contact_floor = from.measurement.no_contact_floor;
       }},
      {"window",
       [](Config& to, const Config& from) { to.transition.window = from.transition.window; }},
      {"power",
       [](Config& to, const Config& from) { to.transition.power = from.transition.power; }},
      {"median",
       [](Config& to, const Config& from) {
         to.transition.median_of = from.transition.median_of;
         to.transition.nyquist = from.transition.nyquist;
       }},
      {"switch sigmoid",
       [](Config& to, const Config& from) {
         to.transition.switch_sigmoid = from.transition.switch_sigmoid;
       }},
      {"landing sigmoid",
       [](Config& to, const Config& from) {
         to.transition.landing_sigmoid = from.transition.landing_sigmoid;
       }},
      {"margin",
       [](Config& to, const Config& from) { to.transition.margin = from.transition.margin; }},
      {"memory of the median",
       [](Config& to, const Config& from) {
         to.transition.median_memory = from.transition.median_memory;
       }},
      {"rows that sum to one",
       [](Config& to, const Config& from) {
         to.transition.row_stochastic = from.transition.row_stochastic;
       }},
      {"guard", [](Config& to, const Config& from) { to.guard = from.guard; }},
      {"threshold", [](Config& to, const Config& from) { to.threshold = from.threshold; }},
  };
  return all;
}

/// The settings in which both differ. Fails if they still differ after copying all settings: then a
/// field is missing above.
std::vector<std::string> differences(const Config& one, const Config& other) {
  std::vector<std::string> names;
  Config equal = one;
  for (const Setting& setting : settings()) {
    const Config before = equal;
    setting.copy(equal, other);
    if (!(equal == before)) names.emplace_back(setting.name);
  }
  EXPECT_EQ(equal, other);
  return names;
}

std::vector<Config> whole_ablation() {
  std::vector<Config> all = {Config::paper()};
  for (const AblationStep& step : steps_from_paper_to_robust()) all.push_back(step.config);
  all.push_back(Config::robust());
  return all;
}

TEST(BayesAblation, GoesFromPaperToRobustOneChangeAtATime) {
  const std::vector<Config> steps = whole_ablation();
  std::set<std::string> changed;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const std::vector<std::string> change = differences(steps[i], steps[i + 1]);
    ASSERT_EQ(change.size(), 1U) << "after step " << i;
    EXPECT_TRUE(changed.insert(change.front()).second) << change.front() << " changes twice";
  }
  const std::vector<std::string> between_ends = differences(Config::paper(), Config::robust());
  EXPECT_EQ(changed, std::set<std::string>(between_ends.begin(), between_ends.end()));
  EXPECT_EQ(between_ends.size(), 10U);
}

TEST(BayesAblation, HasTheOtherReadingOfThePowerBesideItsFirstStep) {
  EXPECT_EQ(differences(Config::paper(), Config::paper_rms()), std::vector<std::string>{"power"});
  EXPECT_EQ(Config::paper().transition.power, Config::robust().transition.power);
}

TEST(BayesAblation, LacksOnlyRowsThatSumToOneAtItsLastStep) {
  const std::span<const AblationStep> steps = steps_from_paper_to_robust();
  ASSERT_FALSE(steps.empty());
  Config last = steps.back().config;
  EXPECT_NE(last, Config::robust());
  last.transition.row_stochastic = true;
  EXPECT_EQ(last, Config::robust());
}

}  // namespace
}  // namespace touchdown
