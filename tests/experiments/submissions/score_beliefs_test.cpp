#include "experiments/submissions/score_beliefs.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Beliefs about both wheels at these times.
logs::Beliefs beliefs_at(const std::vector<double>& times, const std::vector<double>& p) {
  logs::Beliefs beliefs;
  beliefs.file = "a.npz";
  beliefs.time = times;
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    beliefs.p_contact[w] = p;
    for (const double one : p) beliefs.contact[w].push_back(one >= 0.5 ? 1 : 0);
  }
  return beliefs;
}

TEST(SubmittedPrediction, HoldsTheLastBeliefAndBeginsWithOneHalf) {
  const RunSignals run = synthetic_run(1, 6);
  const auto submitted = prediction_of(beliefs_at({0.001, 0.004}, {0.25, 0.75}), run);
  EXPECT_THAT(submitted.prediction[0].p_contact, ElementsAre(0.5, 0.25, 0.25, 0.25, 0.75, 0.75));
  EXPECT_THAT(submitted.prediction[1].contact, ElementsAre(1, 0, 0, 0, 1, 1));
  EXPECT_EQ(submitted.without, 4U);
}

TEST(SubmittedPrediction, TakesABeliefForTheStepThatIsNearest) {
  const RunSignals run = synthetic_run(1, 4);
  const auto submitted = prediction_of(beliefs_at({0.0004, 0.0006, 0.0024}, {0.1, 0.2, 0.3}), run);
  EXPECT_THAT(submitted.prediction[0].p_contact, ElementsAre(0.1, 0.2, 0.3, 0.3));
  EXPECT_EQ(submitted.without, 1U);
}

TEST(SubmittedPrediction, NeedsNoBeliefWhereThereIsNoRecord) {
  RunSignals run = synthetic_run(1, 4);
  run.signals[2].time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(prediction_of(beliefs_at({0.0, 0.001, 0.003}, {0.1, 0.2, 0.3}), run).without, 0U);
}

TEST(SubmittedPrediction, KeepsDecisionsThatDifferFromTheProbabilities) {
  const RunSignals run = synthetic_run(1, 1);
  logs::Beliefs beliefs = beliefs_at({0.0}, {0.9});
  beliefs.contact[1] = {0};
  const auto submitted = prediction_of(beliefs, run);
  EXPECT_THAT(submitted.prediction[0].contact, ElementsAre(1));
  EXPECT_THAT(submitted.prediction[1].contact, ElementsAre(0));
  EXPECT_THAT(submitted.prediction[1].p_contact, ElementsAre(0.9));
  EXPECT_THAT(submitted.prediction[static_cast<std::size_t>(scoring::View::both_wheels)].contact,
              ElementsAre(0));
}

TEST(SubmittedPrediction, RefusesTimesThatAreNoStepsOfTheRun) {
  const RunSignals run = synthetic_run(1, 4);
  const auto complaint = [&](const std::vector<double>& times, const std::string& expected) {
    const std::vector<double> p(times.size(), 0.5);
    EXPECT_THAT([&] { prediction_of(beliefs_at(times, p), run); },
                ThrowsMessage<InputError>(HasSubstr(expected)));
  };
  complaint({0.0, 0.004},
            "a.npz: belief 1: time 0.004 s: expected one of the run, from 0 to 0.003 s");
  complaint({-0.001}, "a.npz: belief 0: time -0.001 s: expected one of the run");
  complaint({0.001, 0.0012},
            "a.npz: belief 1: time 0.0012 s: expected one belief per step of 1 ms");
  complaint({0.003, 0.0032}, "a.npz: belief 1: time 0.0032 s: expected one belief per step");
}

}  // namespace
}  // namespace touchdown::experiments
