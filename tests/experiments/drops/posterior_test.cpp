#include "experiments/drops/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct PosteriorStudy {
  PosteriorStudy() { config.choice = {.run = 3, .drop = 1, .seed = 1}; }

  Experiment experiment = synthetic_experiment({"phase"});
  FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  PosteriorConfig config;
};

TEST(DropPosterior, AddsUpToOneAndMatchesTheStudysEstimator) {
  const PosteriorStudy study;
  const RunSignals run = synthetic_run(3);
  const DropPosterior posterior = drop_posterior(study.experiment, study.config, run, study.models);
  ASSERT_EQ(posterior.time.size(), 601U);
  const auto estimator =
      make_estimator(study.experiment, {"mujoco", "mujoco", "phase"}, study.models, run);
  const scoring::Prediction prediction =
      predict(*estimator, run, noise_run(run, noise_key(study.experiment, 1, 3)),
              study.config.noise.levels());
  for (std::size_t row = 0; row < posterior.time.size(); ++row) {
    const PhaseProbabilities& p = posterior.phases[row];
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-9);
    double left = 0.0, right = 0.0;
    for (std::size_t phase = 0; phase < phase_count; ++phase) {
      EXPECT_GE(p[phase], 0.0);
      left += left_in_contact(static_cast<Phase>(phase)) ? p[phase] : 0.0;
      right += right_in_contact(static_cast<Phase>(phase)) ? p[phase] : 0.0;
    }
    EXPECT_NEAR(posterior.p_contact[0][row], left, 1e-9);
    EXPECT_NEAR(posterior.p_contact[1][row], right, 1e-9);
    EXPECT_EQ(posterior.p_contact[0][row], prediction[0].p_contact[1458 + row]);
    EXPECT_EQ(posterior.p_contact[1][row], prediction[1].p_contact[1458 + row]);
  }
}

TEST(DropPosterior, HasTheTruePhasesBesideTheEstimated) {
  const PosteriorStudy study;
  const DropPosterior posterior =
      drop_posterior(study.experiment, study.config, synthetic_run(3), study.models);
  // Steps since the window's first; the left wheel leaves at 142, the right one at 150, both land
  // at 342. Single-wheel phases shorter than the shortest flight are filled.
  EXPECT_EQ(posterior.truth[200], Phase::flight);
  EXPECT_EQ(posterior.truth[343], Phase::impact_1);
  EXPECT_EQ(posterior.truth[135], Phase::unloading_3);
  EXPECT_EQ(posterior.truth[360], Phase::impact_2);
  EXPECT_EQ(posterior.contact[0][145], 0);
  EXPECT_EQ(posterior.contact[1][145], 1);
  EXPECT_GT(posterior.phases[300][index(Phase::flight)], 0.9);
}

/// Eq. of docs/explanation/phase_filter.md, done again with the model's transitions.
TEST(DropPosterior, FollowsFromThePreviousPosteriorAndTheStepsEvidence) {
  const PosteriorStudy study;
  const RunSignals run = synthetic_run(3);
  const DropPosterior posterior = drop_posterior(study.experiment, study.config, run, study.models);
  const PhaseModel& model =
      *setup_of(study.experiment, {"mujoco", "mujoco", "phase"}, study.models, run).model->phase;
  for (std::size_t k = 1; k < posterior.time.size(); ++k) {
    PhaseProbabilities expected{};
    double sum = 0.0;
    for (std::size_t j = 0; j < phase_count; ++j) {
      for (std::size_t i = 0; i < phase_count; ++i) {
        expected[j] += posterior.phases[k - 1][i] * model.transition[i][j];
      }
      expected[j] *= std::exp(posterior.evidence[k].sum(static_cast<Phase>(j)));
      sum += expected[j];
    }
    for (std::size_t j = 0; j < phase_count; ++j) {
      EXPECT_NEAR(posterior.phases[k][j], expected[j] / sum, 1e-5) << k << " " << phase_names[j];
    }
  }
}

TEST(DropPosterior, LogLikelihoodErrorsAddUpToTheLogRatioOfTheBelief) {
  const PosteriorStudy study;
  const DropPosterior posterior =
      drop_posterior(study.experiment, study.config, synthetic_run(3), study.models);
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < posterior.time.size(); ++k) {
    const PhaseProbabilities& p = posterior.phases[k];
    const auto first = static_cast<Phase>(std::max_element(p.begin(), p.end()) - p.begin());
    const Phase truth = posterior.truth[k];
    const LogLikelihoodError& error = posterior.log_likelihood_error[k];
    const double sum = error.left + error.right + error.acceleration + error.memory;
    const bool is_right = left_in_contact(first) == left_in_contact(truth) &&
                          right_in_contact(first) == right_in_contact(truth);
    if (is_right) {
      EXPECT_EQ(sum, 0.0);
    } else {
      EXPECT_NEAR(sum, std::log(p[index(first)] / p[index(truth)]), 1e-9);
      EXPECT_GE(sum, 0.0);
    }
    wrong += is_right ? 0 : 1;
  }
  EXPECT_GT(wrong, 0U);  // a takeoff is detected some steps late
}

TEST(DropPosterior, ShowsDropsOfTheChosenWheel) {
  PosteriorStudy study;
  const auto takeoff = [&](DropWheels wheels) {
    study.config.choice.wheels = wheels;
    const RunSignals run = synthetic_run(3);
    const DropPosterior posterior =
        drop_posterior(study.experiment, study.config, run, study.models);
    const auto at = static_cast<std::size_t>(
        std::find(posterior.time.begin(), posterior.time.end(), 0.0) - posterior.time.begin());
    return std::pair(posterior.contact[0][at], posterior.contact[1][at]);
  };
  EXPECT_EQ(takeoff(DropWheels::both), std::pair(std::uint8_t{0}, std::uint8_t{0}));
  EXPECT_EQ(takeoff(DropWheels::left), std::pair(std::uint8_t{0}, std::uint8_t{1}));
  EXPECT_EQ(takeoff(DropWheels::right), std::pair(std::uint8_t{0}, std::uint8_t{0}));
}

TEST(DropPosterior, ShowsAChosenTime) {
  PosteriorStudy study;
  study.config.choice.at = 0.3;
  const RunSignals run = synthetic_run(3);
  const DropPosterior posterior = drop_posterior(study.experiment, study.config, run, study.models);
  ASSERT_EQ(posterior.time.size(), 601U);
  EXPECT_NEAR(posterior.time.front(), -0.15, 1e-12);
  EXPECT_EQ(posterior.contact[0][449], run.contact[0][599]);
  EXPECT_EQ(posterior.contact[0][450], run.contact[0][600]);
  EXPECT_NE(posterior.contact[0][449], posterior.contact[0][450]);
  study.config.choice.at = 4.0;
  EXPECT_THAT([&] { drop_posterior(study.experiment, study.config, run, study.models); },
              ThrowsMessage<InputError>(HasSubstr("posterior.at: run 3 in mujoco ends after 4 s")));
}

TEST(DropPosterior, NamesTheExistingDropsIfTheChosenOneIsMissing) {
  PosteriorStudy study;
  study.config.choice.drop = 4;
  EXPECT_THAT(
      [&] { drop_posterior(study.experiment, study.config, synthetic_run(3), study.models); },
      ThrowsMessage<InputError>(
          HasSubstr("posterior.drop: run 3 in mujoco has 4 drops of both wheels")));
}

}  // namespace
}  // namespace touchdown::experiments
