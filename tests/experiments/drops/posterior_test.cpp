#include "experiments/drops/posterior.hpp"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/fitting/make_estimator.hpp"
#include "experiments/plan/condition.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct PosteriorStudy {
  PosteriorStudy() { config.choice = {.run = 3, .drop = 1, .seed = 1}; }

  Experiment experiment = synthetic_experiment({"phase"});
  FittedModels models = fit_models(experiment, {synthetic_run(first_fit_run)});
  PosteriorConfig config;
};

TEST(DropPosterior, AddsUpToOneAndToWhatTheStudyHears) {
  const PosteriorStudy study;
  const RunSignals run = synthetic_run(3);
  const DropPosterior posterior = drop_posterior(study.experiment, study.config, run, study.models);
  ASSERT_EQ(posterior.time.size(), 601U);
  const auto estimator = make_estimator({"mujoco", "mujoco", "phase"}, study.models, run);
  const scoring::Prediction prediction =
      predict(*estimator, run, noise_run(run, noise_key(study.experiment, 1, 3)),
              study.config.noise.levels());
  for (std::size_t row = 0; row < posterior.time.size(); ++row) {
    const PhaseProbabilities& p = posterior.phases[row];
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-9);
    double left = 0.0, right = 0.0;
    for (std::size_t phase = 0; phase < phase_count; ++phase) {
      EXPECT_GE(p[phase], 0.0);
      left += left_touches(static_cast<Phase>(phase)) ? p[phase] : 0.0;
      right += right_touches(static_cast<Phase>(phase)) ? p[phase] : 0.0;
    }
    EXPECT_NEAR(posterior.p_contact[0][row], left, 1e-9);
    EXPECT_NEAR(posterior.p_contact[1][row], right, 1e-9);
    EXPECT_EQ(posterior.p_contact[0][row], prediction[0].p_contact[1458 + row]);
    EXPECT_EQ(posterior.p_contact[1][row], prediction[1].p_contact[1458 + row]);
  }
}

TEST(DropPosterior, KnowsTheTruePhasesBesideTheBelieved) {
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

TEST(DropPosterior, NamesTheDropsThereAreWhereOneIsMissing) {
  PosteriorStudy study;
  study.config.choice.drop = 4;
  EXPECT_THAT(
      [&] { drop_posterior(study.experiment, study.config, synthetic_run(3), study.models); },
      ThrowsMessage<InputError>(HasSubstr("posterior.drop: run 3 in mujoco has 4 drops")));
}

}  // namespace
}  // namespace touchdown::experiments
