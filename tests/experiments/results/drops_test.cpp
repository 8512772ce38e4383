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
#include "estimator/force/load_filter.hpp"
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

/// The decisions that follow from the probabilities; the load filter has hysteresis.
scoring::ContactSequence decisions(const BeliefTrace& trace) {
  const LoadFilterConfig loads;
  scoring::ContactSequence contact;
  bool in_contact = true;
  for (const double p : trace.p_contact) {
    in_contact = p >= (trace.estimator != "load_filter" ? 0.8
                       : in_contact                     ? loads.leave_below
                                                        : loads.return_above);
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
  Study study({"robust", "reference", "measurement_only", "load_filter"});
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
  const DropDetail detail = Study({"robust", "load_filter"}).detail(run);
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

TEST(DropDetail, ShowsDropsOfTheChosenWheel) {
  Study study({"robust"});
  const RunSignals run = synthetic_run(3);
  const auto takeoff = [&](DropWheels wheels) {
    study.config.choice.wheels = wheels;
    const DropDetail detail = study.detail(run);
    const auto at = static_cast<std::size_t>(
        std::find(detail.time.begin(), detail.time.end(), 0.0) - detail.time.begin());
    const auto first = std::find(detail.contact.begin(), detail.contact.end(), std::uint8_t{0});
    return at - static_cast<std::size_t>(first - detail.contact.begin());
  };
  // The left wheel is first off the ground, by 8 steps.
  EXPECT_EQ(takeoff(DropWheels::both), 8U);
  EXPECT_EQ(takeoff(DropWheels::left), 0U);
  EXPECT_EQ(takeoff(DropWheels::right), 8U);
}

TEST(DropDetail, ShowsAChosenTime) {
  Study study({"robust"});
  study.config.choice.at = 0.3;
  const RunSignals run = synthetic_run(3);
  const DropDetail detail = study.detail(run);
  ASSERT_EQ(detail.time.size(), 601U);
  EXPECT_NEAR(detail.time.front(), -0.15, 1e-12);
  EXPECT_EQ(detail.contact[449], run.contact[0][599]);
  EXPECT_EQ(detail.contact[450], run.contact[0][600]);
  EXPECT_NE(detail.contact[449], detail.contact[450]);
  study.config.choice.at = 4.0;
  EXPECT_THAT([&] { study.detail(run); },
              ThrowsMessage<InputError>(HasSubstr("detail.at: run 3 in mujoco ends after 4 s")));
}

}  // namespace
}  // namespace touchdown::experiments
