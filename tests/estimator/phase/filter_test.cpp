#include "estimator/phase/filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/phase/synthetic.hpp"

namespace touchdown {
namespace {

/// The forward algorithm of a textbook: dense sums, densities summed sample by sample. It shares
/// only the definition with the filter.
class DirectForward {
 public:
  DirectForward(const test::PhaseRun& run, const PhaseFilterConfig& config, PhaseNoise noise)
      : config_(config), noise_(noise) {
    const auto phases =
        label_phases({WheelContact(run.contact[0]), WheelContact(run.contact[1])},
                     held_steps(run.signals, 1000.0, config.fit.labels), 1000.0, config.fit.labels);
    double count[12][12] = {};
    const auto mirror = [](int i) { return i == 10 ? 11 : (i == 11 ? 10 : i); };
    for (std::size_t k = 0; k < phases.size(); ++k) {
      const int j = static_cast<int>(phases[k]);
      if (k > 0) {
        const int i = static_cast<int>(phases[k - 1]);
        count[i][j] += 0.5;
        count[mirror(i)][mirror(j)] += 0.5;
      }
      const Signals& s = run.signals[k];
      acceleration_[std::min(j, 10)].push_back(s.vertical_acceleration);
      torque_[j].push_back({s.leg[0].knee.torque, s.leg[0].wheel.torque});
      torque_[mirror(j)].push_back({-s.leg[1].knee.torque, -s.leg[1].wheel.torque});
    }
    // For the left leg: in phase 10 it carries the robot alone, in phase 11 the other leg does.
    is_borrowed_ = static_cast<double>(torque_[10].size()) / 1000.0 < config.fit.least_single_wheel;
    for (int i = 0; i < 12; ++i) {
      double sum = 0.0;
      for (int j = 0; j < 12; ++j) sum += count[i][j] + config.fit.pseudo_count;
      for (int j = 0; j < 12; ++j) a_[i][j] = (count[i][j] + config.fit.pseudo_count) / sum;
    }
    alpha_ = {0.5, 0, 0, 0, 0.25, 0, 0, 0, 0.25, 0, 0, 0};
  }

  void update(const Signals& s) {
    const double knee[2] = {s.leg[0].knee.torque, -s.leg[1].knee.torque};
    const double wheel[2] = {s.leg[0].wheel.torque, -s.leg[1].wheel.torque};
    std::array<double, 12> next{};
    double sum = 0.0;
    for (int j = 0; j < 12; ++j) {
      const auto density_of = [&](int k) {
        return !is_borrowed_ || k < 10 ? k : (k == 10 ? 0 : 4);
      };
      const int left = density_of(j);
      const int right = density_of(j == 10 ? 11 : (j == 11 ? 10 : j));
      for (int i = 0; i < 12; ++i) {
        next[static_cast<std::size_t>(j)] += alpha_[static_cast<std::size_t>(i)] * a_[i][j];
      }
      next[static_cast<std::size_t>(j)] *=
          std::pow(torque_density(left, knee[0], wheel[0]), config_.torque_exponent) *
          std::pow(torque_density(right, knee[1], wheel[1]), config_.torque_exponent) *
          std::pow(acceleration_density(std::min(j, 10), s.vertical_acceleration),
                   config_.acceleration_exponent);
      sum += next[static_cast<std::size_t>(j)];
    }
    for (double& p : next) p /= sum;
    alpha_ = next;
  }

  [[nodiscard]] const std::array<double, 12>& alpha() const { return alpha_; }

 private:
  double torque_density(int phase, double knee, double wheel) const {
    const double h2 = config_.fit.torque_bandwidth * config_.fit.torque_bandwidth;
    const double k = std::sqrt(h2 + noise_.knee_torque * noise_.knee_torque);
    const double w = std::sqrt(h2 + noise_.wheel_torque * noise_.wheel_torque);
    const double uniform = 1.0 / (2.0 * (17.0 + 4.0 * k) * 2.0 * (1.8 + 4.0 * w));
    if (torque_[phase].empty()) return uniform;
    double sum = 0.0;
    for (const TorqueSample& s : torque_[phase]) {
      sum +=
          std::exp(-0.5 * (std::pow((s.knee - knee) / k, 2) + std::pow((s.wheel - wheel) / w, 2)));
    }
    sum /= static_cast<double>(torque_[phase].size()) * 2.0 * std::numbers::pi * k * w;
    return 0.999 * sum + 0.001 * uniform;
  }

  double acceleration_density(int phase, double a) const {
    const double h2 = config_.fit.acceleration_bandwidth * config_.fit.acceleration_bandwidth +
                      noise_.acceleration * noise_.acceleration;
    const double h = std::sqrt(h2);
    const double uniform = 1.0 / (2.0 * (300.0 + 4.0 * h));
    if (acceleration_[phase].empty()) return uniform;
    double sum = 0.0;
    for (const double s : acceleration_[phase]) sum += std::exp(-(s - a) * (s - a) / (2.0 * h2));
    sum /=
        static_cast<double>(acceleration_[phase].size()) * std::sqrt(2.0 * std::numbers::pi * h2);
    return 0.999 * sum + 0.001 * uniform;
  }

  PhaseFilterConfig config_;
  PhaseNoise noise_;
  std::vector<TorqueSample> torque_[12];
  bool is_borrowed_ = false;
  std::vector<double> acceleration_[11];
  double a_[12][12] = {};
  std::array<double, 12> alpha_{};
};

double nearest_point(const Axis& axis, double value) {
  const double i = std::round((value - axis.lower) / axis.step());
  return axis[static_cast<int>(std::clamp(i, 0.0, axis.count - 1.0))];
}

class PhaseForward : public testing::TestWithParam<double> {};

/// With the signals moved to the grids' points, at a noise level of the densities, the filter does
/// not interpolate. It must agree to the grids' single precision.
TEST_P(PhaseForward, IsTheForwardAlgorithmWithKernelDensities) {
  PhaseFilterConfig config;
  config.fit = test::small_phase_fit();
  config.fit.least_single_wheel = GetParam();
  config.noise = PhaseNoise{0.4, 0.0, 2.0};
  const test::PhaseRun run = test::phase_run(2, 11, 25);
  const PhaseModel model = fit_phase_model(std::vector{run.view()}, 1000.0, config.fit);
  ASSERT_GT(model.seconds[index(Phase::right_only)], 0.04);
  PhaseFilter filter(model, config);
  DirectForward direct(run, config, *config.noise);

  test::PhaseRun other = test::phase_run(1, 12, 25, 0.4);
  const PhaseTorqueDensity& grid = model.torque[2];
  for (std::size_t k = 550; k < 1100; ++k) {
    Signals s = other.signals[k];
    for (int side = 0; side < 2; ++side) {
      const double sign = side == 0 ? 1.0 : -1.0;
      LegSignals& leg = s.leg[static_cast<std::size_t>(side)];
      leg.knee.torque = sign * nearest_point(grid.knee, sign * leg.knee.torque);
      leg.wheel.torque = sign * nearest_point(grid.wheel, sign * leg.wheel.torque);
    }
    s.vertical_acceleration = nearest_point(model.acceleration[1].axis, s.vertical_acceleration);
    const Belief& belief = filter.update(s);
    direct.update(s);
    const PhaseProbabilities phases = filter.phases();
    for (std::size_t i = 0; i < phase_count; ++i) {
      ASSERT_NEAR(phases[i], direct.alpha()[i], 1e-4) << "step " << k << " " << phase_names[i];
    }
    const auto& a = direct.alpha();
    ASSERT_NEAR(belief.wheel[0].p_contact, 1.0 - a[4] - a[8] - a[11], 1e-4);
    ASSERT_NEAR(belief.wheel[1].p_contact, 1.0 - a[4] - a[8] - a[10], 1e-4);
    ASSERT_NEAR(belief.p_any_wheel, 1.0 - a[4] - a[8], 1e-4);
    ASSERT_NEAR(belief.p_both_wheels, 1.0 - a[4] - a[8] - a[10] - a[11], 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(BorrowedAndOwnSingleWheels, PhaseForward, testing::Values(0.5, 0.0));

class PhaseFilterInNoise : public testing::TestWithParam<PhaseNoise> {};

TEST_P(PhaseFilterInNoise, InterpolatesCloselyBetweenPointsAndNoiseLevels) {
  PhaseFilterConfig config;  // the usual grids and levels
  config.noise = GetParam();
  const test::PhaseRun run = test::phase_run(2, 11);
  const PhaseModel model = fit_phase_model(std::vector{run.view()}, 1000.0, config.fit);
  PhaseFilter filter(model, config);
  DirectForward direct(run, config, *config.noise);
  const test::PhaseRun other = test::phase_run(1, 13, 0, 0.3);
  double difference = 0.0;
  for (std::size_t k = 550; k < 1100; ++k) {
    const Belief& belief = filter.update(other.signals[k]);
    direct.update(other.signals[k]);
    difference += std::abs(belief.p_any_wheel - (1.0 - direct.alpha()[4] - direct.alpha()[8]));
  }
  EXPECT_LT(difference / 550.0, 2e-3);
}
INSTANTIATE_TEST_SUITE_P(KneeAndWheel, PhaseFilterInNoise,
                         testing::Values(PhaseNoise{0.3, 0.3, 1.5}, PhaseNoise{0.3, 0.06, 1.5},
                                         PhaseNoise{0.1, 0.6, 1.5}, PhaseNoise{0.0, 2.5, 0.0}));

/// With noise on one channel only, the filter must use the other channel and distrust the noisy
/// one.
TEST(PhaseFilter, DistinguishesNoiseOfTheKneesFromNoiseOfTheWheels) {
  const test::PhaseRun run = test::phase_run(4, 21);
  PhaseFilter filter(fit_phase_model(std::vector{test::phase_run(4, 7, 6).view()}, 1000.0, {}));
  for (const bool noisy_knee : {false, true}) {
    filter.reset();
    test::Normal normal(5);
    int wrong = 0;
    for (std::size_t k = 0; k < 4000; ++k) {
      Signals s = run.signals[k];
      for (LegSignals& leg : s.leg) {
        (noisy_knee ? leg.knee : leg.wheel).torque += 4.0 * normal();
      }
      const Belief& belief = filter.update(s);
      if (k >= 300) wrong += belief.wheel[0].contact != (run.contact[0][k] != 0) ? 1 : 0;
    }
    EXPECT_LT(wrong, 40);
    const PhaseNoise noise = filter.noise();
    EXPECT_NEAR(noisy_knee ? noise.knee_torque : noise.wheel_torque, 4.0, 0.5);
    EXPECT_LT(noisy_knee ? noise.wheel_torque : noise.knee_torque, 0.05);
  }
}

TEST(PhaseFilter, FindsFlightsThroughUnknownNoise) {
  const PhaseModel model = test::small_phase_model();
  PhaseFilter filter(model);
  const test::PhaseRun run = test::phase_run(3, 21, 0, 0.3);
  int wrong = 0;
  for (std::size_t k = 0; k < 3000; ++k) {
    const Belief& belief = filter.update(run.signals[k]);
    if (k >= 300) wrong += belief.wheel[0].contact != (run.contact[0][k] != 0) ? 1 : 0;
  }
  EXPECT_LT(wrong, 60);
  EXPECT_NEAR(filter.noise().knee_torque, 0.32, 0.08);
  EXPECT_NEAR(filter.noise().wheel_torque, 0.32, 0.08);
  EXPECT_NEAR(filter.noise().acceleration, 0.6, 0.2);
}

TEST(PhaseFilter, SwapsItsBeliefsWhenTheLegsSwapSignals) {
  const PhaseModel model = test::small_phase_model();
  PhaseFilter filter(model);
  PhaseFilter swapped(model);
  const test::PhaseRun run = test::phase_run(2, 5, 30, 0.2);
  for (const Signals& s : run.signals) {
    Signals mirror = s;
    for (int side = 0; side < 2; ++side) {
      const LegSignals& other = s.leg[static_cast<std::size_t>(1 - side)];
      LegSignals& leg = mirror.leg[static_cast<std::size_t>(side)];
      leg.knee.torque = -other.knee.torque;
      leg.wheel.torque = -other.wheel.torque;
    }
    const Belief& belief = filter.update(s);
    const Belief& mirrored_belief = swapped.update(mirror);
    ASSERT_NEAR(belief.wheel[0].p_contact, mirrored_belief.wheel[1].p_contact, 1e-6);
    ASSERT_NEAR(belief.wheel[1].p_contact, mirrored_belief.wheel[0].p_contact, 1e-6);
    ASSERT_EQ(belief.wheel[0].contact, mirrored_belief.wheel[1].contact);
    ASSERT_NEAR(belief.p_any_wheel, mirrored_belief.p_any_wheel, 1e-6);
  }
}

TEST(PhaseFilter, DecidesWithHysteresis) {
  const PhaseModel model = test::small_phase_model();
  PhaseFilter filter(model);
  const test::PhaseRun run = test::phase_run(3, 9, 0, 1.5);
  bool contact = true;
  int between = 0;
  for (const Signals& s : run.signals) {
    const WheelBelief& wheel = filter.update(s).wheel[0];
    if (wheel.p_contact < 0.25) contact = false;
    if (wheel.p_contact > 0.75) contact = true;
    between += wheel.p_contact > 0.25 && wheel.p_contact < 0.75 ? 1 : 0;
    ASSERT_EQ(wheel.contact, contact);
  }
  EXPECT_GT(between, 10);
}

TEST(PhaseFilter, AtFifthOfTheRateFindsTheSameFlights) {
  const PhaseModel model = test::small_phase_model();
  PhaseFilterConfig config;
  config.sample_rate = 200.0;
  PhaseFilter filter(model, config);
  const test::PhaseRun run = test::phase_run(3, 21, 0, 0.1);
  int wrong = 0;
  for (std::size_t k = 0; k < 3000; k += 5) {
    const Belief& belief = filter.update(run.signals[k]);
    if (k >= 300) wrong += belief.wheel[0].contact != (run.contact[0][k] != 0) ? 1 : 0;
  }
  EXPECT_LT(wrong, 20);
  config.sample_rate = 300.0;
  EXPECT_THROW(PhaseFilter(model, config), InputError);
}

TEST(PhaseFilter, RelaxesToThePriorWithoutSignals) {
  const PhaseModel model = test::small_phase_model();
  PhaseFilter filter(model);
  const test::PhaseRun run = test::phase_run(1, 4);
  for (std::size_t k = 0; k < 400; ++k) filter.update(run.signals[k]);
  EXPECT_GT(filter.belief().wheel[0].p_contact, 0.99);
  Signals s = run.signals[400];
  for (int k = 400; k < 1400; ++k) {
    s.time = 0.001 * k;
    s.vertical_acceleration = std::nan("");
    filter.update(s);
  }
  EXPECT_EQ(filter.belief().status, SignalStatus::invalid);
  EXPECT_NEAR(filter.belief().wheel[0].p_contact, 0.5, 0.01);
  EXPECT_NEAR(filter.belief().wheel[1].p_contact, 0.5, 0.01);
  s = run.signals[401];
  s.time = 100.0;
  EXPECT_EQ(filter.update(s).status, SignalStatus::gap);
}

TEST(PhaseFilter, ContinuesWithOneLeg) {
  const PhaseModel model = test::small_phase_model();
  PhaseFilter filter(model);
  const test::PhaseRun run = test::phase_run(2, 4);
  for (std::size_t k = 0; k < 1800; ++k) {
    Signals s = run.signals[k];
    s.leg[1].knee.torque = std::nan("");
    EXPECT_EQ(filter.update(s).status, SignalStatus::invalid);
    if (k == 1500) {
      EXPECT_GT(filter.belief().wheel[0].p_contact, 0.95);
    }
  }
  EXPECT_LT(filter.belief().wheel[0].p_contact, 0.05);
}

TEST(PhaseFilter, RefusesInvalidValues) {
  const PhaseModel model = test::small_phase_model();
  const auto with = [](const auto& change) {
    PhaseFilterConfig config;
    change(config);
    return config;
  };
  EXPECT_THROW(PhaseFilter(model, with([](auto& c) { c.sample_rate = 0.0; })), InputError);
  EXPECT_THROW(PhaseFilter(model, with([](auto& c) { c.torque_exponent = -1.0; })), InputError);
  EXPECT_THROW(PhaseFilter(model, with([](auto& c) { c.leave_below = 0.9; })), InputError);
  EXPECT_THROW(PhaseFilter(model, with([](auto& c) { c.noise_gain = 0.0; })), InputError);
  EXPECT_THROW(PhaseFilter(model, with([](auto& c) { c.noise_floor.knee_torque = 0.0; })),
               InputError);
  EXPECT_THROW(PhaseFilter(model, with([](auto& c) {
                             c.noise = PhaseNoise{0.0, -1.0, 0.0};
                           })),
               InputError);
  PhaseModel empty;
  EXPECT_THROW(PhaseFilter{empty}, InputError);
}

}  // namespace
}  // namespace touchdown
