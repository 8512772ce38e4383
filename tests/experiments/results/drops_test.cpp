#include "experiments/results/drops.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/phase/config.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The ground truth of a synthetic run's base: half a millimetre higher at every step.
logs::Recording rising(const RunSignals& run) {
  logs::Recording recording;
  recording.info = run.info;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    models::GroundTruth truth;
    truth.base_position.z() = 5e-4 * static_cast<double>(k);
    recording.truth.push_back(truth);
  }
  return recording;
}

struct Study {
  explicit Study(std::vector<std::string> estimators)
      : experiment(synthetic_experiment(estimators)),
        models(fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}))) {
    config.choice = {.run = 3, .drop = 2, .seed = 1};
    config.noise = {{0.5, 3.0}, {2.0, 8.0}};
    config.estimators = std::move(estimators);
  }
  DropDetail detail(const RunSignals& run) const {
    return drop_detail(experiment, config, rising(run), run, models);
  }

  Experiment experiment;
  FittedModels models;
  DetailConfig config;
};

/// The decisions that follow from the probabilities; the phase filter has hysteresis.
scoring::ContactSequence decisions(const BeliefTrace& trace) {
  const PhaseFilterConfig phase;
  scoring::ContactSequence contact;
  bool in_contact = true;
  for (const double p : trace.p_contact) {
    in_contact = trace.estimator == "phase"
                     ? (in_contact ? p >= phase.leave_below : p > phase.return_above)
                     : p >= 0.8;
    contact.push_back(std::uint8_t{in_contact});
  }
  return contact;
}

TEST(DropDetail, IsTheWindowAroundTheChosenDrop) {
  const DropDetail detail = Study({"robust"}).detail(synthetic_run(3));
  // Both wheels are off the ground from 2.608 s, the left one from 2.6 s, until 2.8 s.
  ASSERT_EQ(detail.time.size(), 601U);
  EXPECT_NEAR(detail.time.front(), -0.15, 1e-12);
  EXPECT_NEAR(detail.time.back(), 0.45, 1e-12);
  EXPECT_EQ(detail.height[150], 0.0);
  EXPECT_NEAR(detail.height[350], 0.1, 1e-12);
  for (std::size_t k = 0; k < detail.time.size(); ++k) {
    EXPECT_EQ(detail.contact[k], k < 142 || k >= 342) << k;
  }
  ASSERT_EQ(detail.noisy.size(), 2U);
  EXPECT_EQ(detail.spectrum.spectrum.size(), 301U);
  EXPECT_EQ(detail.spectrum.spectrum.front().size(), 65U);
  EXPECT_EQ(detail.noisy[1].noise.torque, 2.0);
}

TEST(DropDetail, ShowsTheBeliefsThatTheStudyCounts) {
  Study study({"robust", "reference", "measurement_only", "phase"});
  study.config.choice.before = study.config.choice.after = 10.0;  // the whole run
  const RunSignals run = synthetic_run(3);
  const DropDetail detail = study.detail(run);
  ASSERT_EQ(detail.time.size(), run.steps());
  const NoiseRun noise = noise_run(run, noise_key(study.experiment, 1, 3));
  const auto count = [&](const scoring::ContactSequence& truth,
                         const scoring::ContactSequence& estimate) {
    return scoring::classify(truth, estimate, run.segments, run.info.control_period_us,
                             study.experiment.scoring);
  };
  for (const NoisyDrop& drop : detail.noisy) {
    const std::vector<noise::NoiseCell> cells = {drop.noise};
    for (const BeliefTrace& trace : drop.beliefs) {
      const std::vector<Condition> condition = {{"mujoco", "mujoco", trace.estimator}};
      const auto swept = sweep_run(condition, cells, run, noise, study.models, study.experiment,
                                   [] { return true; });
      // The sweep counts both wheels; a second filter gives the right wheel's share.
      const auto estimator = make_estimator(study.experiment, condition[0], study.models, run);
      const auto right = decide(*estimator, run, noise, drop.noise.levels())[1];
      auto both = count(run.contact[0], decisions(trace));
      const auto rights = count(run.contact[1], right);
      for (std::size_t i = 0; i < both.size(); ++i) both[i] += rights[i];
      EXPECT_EQ(both, swept) << trace.estimator;
    }
  }
}

TEST(DropDetail, SpectraArePlainTransformsOfTheFiltersInput) {
  const Study study({"measurement_only", "robust"});
  const RunSignals run = synthetic_run(3);
  const DropDetail detail = study.detail(run);
  EXPECT_EQ(detail.bin_width, 1000.0 / 128.0);
  const noise::NoiseKey key = noise_key(study.experiment, 1, 3);
  const NoisyDrop& drop = detail.noisy[1];
  BayesFilter filter(*study.models.at("mujoco").at("robust").grid);
  const NoiseRun noise = noise_run(run, key);
  for (std::size_t k = 0; k <= 2608 + 450; ++k) {
    filter.update(noisy(run, noise, drop.noise.levels(), k));
    if (k < 2458 || (k - 2458) % 50 != 0) continue;
    const std::size_t row = k - 2458;
    std::array<double, 128> window;
    double energy = 0.0;
    for (std::size_t n = 0; n < 128; ++n) {
      const std::size_t step = k - 127 + n;
      const Eigen::Vector3d draw(
          noise::standard_normal(key, noise::NoiseChannel::accelerometer_x, step),
          noise::standard_normal(key, noise::NoiseChannel::accelerometer_y, step),
          noise::standard_normal(key, noise::NoiseChannel::accelerometer_z, step));
      window[n] = run.signals[step].vertical_acceleration + 8.0 * run.signals[step].up.dot(draw);
      energy += window[n] * window[n];
    }
    const auto& column = drop.spectrum.spectrum[row / spectrum_stride];
    for (std::size_t bin = 0; bin < column.size(); ++bin) {
      std::complex<double> sum;
      for (std::size_t n = 0; n < 128; ++n) {
        sum += window[n] *
               std::polar(1.0, -2.0 * std::numbers::pi / 128.0 * static_cast<double>(bin * n));
      }
      EXPECT_NEAR(column[bin], std::norm(sum) / 128.0, 1e-9 * energy) << k << " " << bin;
    }
    EXPECT_NEAR(drop.spectrum.power[row], energy / 128.0, 1e-9 * energy);
    EXPECT_EQ(drop.spectrum.p_switch[row], filter.transition().p_switch);
    EXPECT_EQ(drop.spectrum.p_takeoff[row], filter.transition().contact_to_air);
    EXPECT_EQ(drop.spectrum.p_landing[row], filter.transition().air_to_contact);
    EXPECT_EQ(drop.spectrum.median_frequency[row], filter.transition().median_frequency);
  }
}

TEST(DropDetail, TorquesAreTheLeftLegsWithAndWithoutTheStudysNoise) {
  const Study study({"robust"});
  const RunSignals run = synthetic_run(3);
  const DropDetail detail = study.detail(run);
  const noise::NoiseKey key = noise_key(study.experiment, 1, 3);
  for (std::size_t row = 0; row < detail.time.size(); row += 37) {
    const LegSignals& leg = run.signals[2458 + row].leg[0];
    EXPECT_EQ(detail.torque.knee[row], leg.knee.torque);
    const double draw =
        noise::standard_normal(key, noise::NoiseChannel::left_wheel_torque, 2458 + row);
    EXPECT_NEAR(detail.noisy[1].torque.wheel[row], leg.wheel.torque + 2.0 * draw, 1e-12);
  }
}

TEST(DropDetail, EndsWithTheRun) {
  RunSignals run = synthetic_run(3, 2700);  // ends in its third flight
  const DropDetail detail = Study({"robust"}).detail(run);
  EXPECT_EQ(detail.time.size(), 2700U - 2458U);
  EXPECT_EQ(detail.contact.back(), 0);
  EXPECT_EQ(detail.noisy[0].beliefs[0].p_contact.size(), detail.time.size());
}

TEST(DropDetail, SurvivesSignalsThatAreNoNumbers) {
  RunSignals run = synthetic_run(3);
  run.signals[2500].leg[0].knee.torque = std::nan("");
  run.signals[2510].vertical_acceleration = std::nan("");
  const DropDetail detail = Study({"robust", "phase"}).detail(run);
  EXPECT_TRUE(std::isnan(detail.torque.knee[2500 - 2458]));
  EXPECT_TRUE(std::isnan(detail.noisy[0].spectrum.acceleration[2510 - 2458]));
  for (const double power : detail.noisy[0].spectrum.power) EXPECT_TRUE(std::isfinite(power));
  for (const BeliefTrace& trace : detail.noisy[0].beliefs) {
    for (const double p : trace.p_contact) EXPECT_TRUE(p >= 0.0 && p <= 1.0);
  }
}

TEST(DropDetail, NamesTheExistingDropsIfTheChosenOneIsMissing) {
  Study study({"robust"});
  study.config.choice.drop = 9;
  EXPECT_THAT([&] { study.detail(synthetic_run(3)); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("detail.drop: run 3 in mujoco"),
                                              HasSubstr("4 drops of both wheels, counted from 0"),
                                              HasSubstr("none is number 9"))));
  RunSignals standing = synthetic_run(3, 500);
  EXPECT_THAT([&] { study.detail(standing); }, ThrowsMessage<InputError>(HasSubstr("has no drop")));
}

TEST(Drops, AreFlightsOfBothWheelsThatAreLongEnoughAndBeginInTheRun) {
  std::array<scoring::ContactSequence, models::wheel_count> contact;
  for (scoring::ContactSequence& wheel : contact) wheel.assign(1000, 1);
  const auto lift = [&](std::size_t wheel, std::size_t from, std::size_t to) {
    std::fill(contact[wheel].begin() + static_cast<std::ptrdiff_t>(from),
              contact[wheel].begin() + static_cast<std::ptrdiff_t>(to), std::uint8_t{0});
  };
  for (const std::size_t wheel : {0U, 1U}) {
    lift(wheel, 0, 100);                 // in the air from the first step
    lift(wheel, 200, 240);               // too short
    lift(wheel, 300 + 10 * wheel, 400);  // the left wheel first
    lift(wheel, 900, 1000);              // never lands
  }
  lift(0, 500, 700);  // one wheel only
  EXPECT_EQ(drops(contact, 1e-3, 0.05), (std::vector<scoring::Flight>{{310, 400}, {900, 1000}}));
}

struct PosteriorStudy {
  PosteriorStudy() { config.choice = {.run = 3, .drop = 1, .seed = 1}; }

  DropPosterior posterior(const RunSignals& run = synthetic_run(3)) const {
    return drop_posterior(experiment, config, run, models);
  }

  Experiment experiment = synthetic_experiment({"phase"});
  FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  PosteriorConfig config;
};

TEST(DropPosterior, AddsUpToOneAndMatchesTheStudysEstimator) {
  const PosteriorStudy study;
  const RunSignals run = synthetic_run(3);
  const DropPosterior posterior = study.posterior(run);
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
  const DropPosterior posterior = study.posterior();
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
  const DropPosterior posterior = study.posterior(run);
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
  const DropPosterior posterior = study.posterior();
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
    const DropPosterior posterior = study.posterior(run);
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
  const DropPosterior posterior = study.posterior(run);
  ASSERT_EQ(posterior.time.size(), 601U);
  EXPECT_NEAR(posterior.time.front(), -0.15, 1e-12);
  EXPECT_EQ(posterior.contact[0][449], run.contact[0][599]);
  EXPECT_EQ(posterior.contact[0][450], run.contact[0][600]);
  EXPECT_NE(posterior.contact[0][449], posterior.contact[0][450]);
  study.config.choice.at = 4.0;
  EXPECT_THAT([&] { study.posterior(run); },
              ThrowsMessage<InputError>(HasSubstr("posterior.at: run 3 in mujoco ends after 4 s")));
}

}  // namespace
}  // namespace touchdown::experiments
