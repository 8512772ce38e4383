#include "experiments/stages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Two fitted runs, with these contacts of both wheels at every step.
struct Case {
  std::vector<std::string> estimators;
  std::array<scoring::ContactSequence, 2> first;
  std::array<scoring::ContactSequence, 2> second;
};

Rollout rollout(const PlannedRun& plan, const std::array<scoring::ContactSequence, 2>& contact) {
  Rollout run{{plan, {}}, {}};
  run.signals.contact = contact;
  return run;
}

/// What the check does with the fitted runs of `given`; the second one has this outcome.
void check(const Case& given, logs::Outcome second = logs::Outcome::finished) {
  Experiment experiment;
  experiment.estimators = given.estimators;
  std::vector<Rollout> runs;
  for (const auto& contact : {given.first, given.second}) {
    PlannedRun run;
    run.role = RunRole::fit;
    run.simulator = "bullet";
    run.scenario.name = "scene_" + std::to_string(runs.size());
    runs.push_back(rollout(run, contact));
  }
  runs.back().report.outcome = second;
  require_fittable(experiment, runs);
}

const std::array<scoring::ContactSequence, 2> rolls = {{{1, 1}, {1, 1}}};
const std::array<scoring::ContactSequence, 2> hangs = {{{0, 0}, {0, 0}}};
const std::array<scoring::ContactSequence, 2> lifts_left = {{{1, 0}, {1, 1}}};

TEST(RequireFittable, NamesWhatTheRunsOfAFitLackTheEstimatorsAndTheScenes) {
  EXPECT_THAT(
      [] {
        check({{"free_fall", "robust", "load_filter", "paper"}, rolls, rolls});
      },
      ThrowsMessage<InputError>(
          AllOf(HasSubstr("fit on bullet: robust, paper: fit.scenarios contain no step without "
                          "contact"),
                HasSubstr("scene_0, scene_1"))));
  EXPECT_THAT(
      [] {
        check({{"measurement_only"}, hangs, hangs});
      },
      ThrowsMessage<InputError>(HasSubstr("contain no contact")));
}

TEST(RequireFittable, AcceptsRunsThatHaveItTogether) {
  EXPECT_NO_THROW(check({{"robust", "paper"}, rolls, hangs}));
  EXPECT_NO_THROW(check({{"robust"}, rolls, lifts_left}));
  EXPECT_NO_THROW(check({{"free_fall", "load_filter"}, rolls, rolls}));
}

TEST(RequireFittable, DoesNotUseRunsThatFell) {
  EXPECT_THROW(check({{"robust"}, rolls, hangs}, logs::Outcome::fell), InputError);
}

/// What the check does with runs of which each one fails in another way.
void check_failing(const std::vector<std::string>& estimators) {
  Experiment experiment;
  experiment.estimators = estimators;
  std::vector<Rollout> runs;
  for (const logs::Outcome failure :
       {logs::Outcome::left_terrain, logs::Outcome::fell, logs::Outcome::diverged}) {
    PlannedRun plan;
    plan.role = RunRole::fit;
    plan.simulator = "bullet";
    plan.file = "run_" + std::to_string(static_cast<int>(failure));
    runs.push_back(rollout(plan, rolls));
    runs.back().report.outcome = failure;
    runs.back().report.ending = "ended badly";
  }
  require_fittable(experiment, runs);
}

TEST(RequireFittable, NamesTheFirstFailureIfEveryRunFails) {
  EXPECT_THAT(
      [] {
        check_failing({"robust", "free_fall", "paper"});
      },
      ThrowsMessage<InputError>(
          "fit on bullet: robust, paper: no run of fit.scenarios stayed upright: "
          "run_2 ended badly, and 2 others"));
  EXPECT_NO_THROW(check_failing({"free_fall", "load_filter"}));
}

}  // namespace
}  // namespace touchdown::experiments
