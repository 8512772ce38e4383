#include "estimator/phase/model.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/phase/fit.hpp"
#include "tests/estimator/phase/synthetic.hpp"

namespace touchdown {
namespace {

TEST(PhaseTransitions, AreCountedWithTheirMirrorImage) {
  using enum Phase;
  const std::vector<Phase> phases = {rolling, rolling, rolling, left_only, flight, right_only};
  const PhaseTransition n = count_transitions(phases);
  EXPECT_EQ(n[index(rolling)][index(rolling)], 2.0);
  EXPECT_EQ(n[index(rolling)][index(left_only)], 0.5);
  EXPECT_EQ(n[index(rolling)][index(right_only)], 0.5);
  EXPECT_EQ(n[index(left_only)][index(flight)], 0.5);
  EXPECT_EQ(n[index(right_only)][index(flight)], 0.5);
  EXPECT_EQ(n[index(flight)][index(right_only)], 0.5);
  EXPECT_EQ(n[index(flight)][index(left_only)], 0.5);
  double sum = 0.0;
  for (const auto& row : n) {
    for (const double count : row) sum += count;
  }
  EXPECT_EQ(sum, 5.0);
}

TEST(PhaseTransitions, BecomeProbabilitiesWithPseudoCounts) {
  PhaseTransition counts{};
  counts[0][0] = 97.8;
  counts[0][4] = 10.0;
  const PhaseTransition p = transition_probabilities(counts, 0.2);
  EXPECT_NEAR(p[0][0], 98.0 / 110.2, 1e-15);  // 97.8 + 10 + 12 · 0.2 = 110.2
  EXPECT_NEAR(p[0][4], 10.2 / 110.2, 1e-15);
  EXPECT_NEAR(p[0][1], 0.2 / 110.2, 1e-15);
  EXPECT_NEAR(p[3][7], 1.0 / 12.0, 1e-15);  // never seen: any phase may follow
}

/// (1 − ε) · mean of Gaussians + ε · uniform, summed directly.
double mixture(const std::vector<TorqueSample>& samples, double knee, double wheel,
               const TorqueSample& h, const PhaseFitConfig& c) {
  double sum = 0.0;
  for (const TorqueSample& s : samples) {
    const double u = (s.knee - knee) / h.knee;
    const double v = (s.wheel - wheel) / h.wheel;
    sum += std::exp(-0.5 * (u * u + v * v));
  }
  const double density =
      sum / (static_cast<double>(samples.size()) * 2.0 * std::numbers::pi * h.knee * h.wheel);
  const double uniform =
      1.0 / (2.0 * (c.knee_range + 4.0 * h.knee) * 2.0 * (c.wheel_range + 4.0 * h.wheel));
  return (1.0 - c.contamination) * density + c.contamination * uniform;
}

TEST(PhaseDensities, AreTheDirectSumWithNoiseInTheBandwidth) {
  const PhaseFitConfig config = test::small_phase_fit();
  PhaseSamples samples;
  for (std::size_t phase = 0; phase < torque_density_count; ++phase) {
    const auto knee = test::normals(40, 0.3 * static_cast<double>(phase), 0.5, 1);
    const auto wheel = test::normals(40, 0.1 * static_cast<double>(phase), 0.2, 2);
    for (std::size_t i = 0; i < knee.size(); ++i) {
      samples.torque[phase].push_back({knee[i], wheel[i]});
    }
  }
  const std::array<double, 2> knee_noise = {0.0, 0.4};
  const std::array<double, 3> wheel_noise = {0.0, 0.1, 0.2};
  const std::vector<PhaseTorqueDensity> densities =
      fit_torque_densities(samples, knee_noise, wheel_noise, config);
  ASSERT_EQ(densities.size(), 6U);
  EXPECT_EQ(densities[2].noise, (TorqueSample{0.0, 0.2}));
  const PhaseTorqueDensity& density = densities.back();
  const double own = config.torque_bandwidth;
  const TorqueSample h = {std::sqrt(own * own + 0.4 * 0.4), std::sqrt(own * own + 0.2 * 0.2)};
  EXPECT_NEAR(density.bandwidth.knee, h.knee, 1e-15);
  EXPECT_NEAR(density.bandwidth.wheel, h.wheel, 1e-15);
  for (const int i : {0, density.wheel.count / 2, density.wheel.count - 1}) {
    for (const int j : {0, density.knee.count / 3, density.knee.count - 1}) {
      for (std::size_t phase = 0; phase < torque_density_count; ++phase) {
        const auto at = static_cast<std::size_t>(i * density.knee.count + j);
        EXPECT_NEAR(
            density.log_density[at * torque_density_count + phase],
            std::log(mixture(samples.torque[phase], density.knee[j], density.wheel[i], h, config)),
            2e-6);
      }
    }
  }
}

TEST(PhaseDensities, OfASingleWheelAreBorrowedIfMissing) {
  PhaseSamples samples;
  samples.torque[index(Phase::rolling)] = {{1.0, 0.1}, {1.2, 0.2}};
  samples.torque[index(Phase::flight)] = {{-0.1, 0.0}};
  const std::array<double, 1> no_noise = {0.0};
  const auto at = [&](std::size_t density) {
    std::vector<float> values;
    const auto all = fit_torque_densities(samples, no_noise, no_noise, test::small_phase_fit())
                         .front()
                         .log_density;
    for (std::size_t i = density; i < all.size(); i += torque_density_count) {
      values.push_back(all[i]);
    }
    return values;
  };
  EXPECT_EQ(at(supporting_leg), at(index(Phase::rolling)));
  EXPECT_EQ(at(airborne_leg), at(index(Phase::flight)));
  samples.torque[supporting_leg] = {{2.4, 0.1}};
  EXPECT_NE(at(supporting_leg), at(index(Phase::rolling)));
  EXPECT_EQ(at(airborne_leg), at(index(Phase::flight)));
}

TEST(PhaseDensities, AreUniformWithoutSamples) {
  PhaseSamples samples;
  samples.acceleration[0] = {-1.0, 0.0, 1.0};
  const PhaseFitConfig config;
  const PhaseAccelerationDensity density = fit_acceleration_density(samples, 0.0, config);
  const double uniform = 1.0 / (2.0 * (config.acceleration_range + 4.0));
  EXPECT_NEAR(density.log_density[5], std::log(uniform), 1e-6);
}

TEST(PhaseModel, FitsItsOwnLabels) {
  const PhaseModel model = test::small_phase_model();
  EXPECT_NO_THROW(check_phase_model(model));
  // In four drops the left wheel takes off six steps before the right one. At the beginning of
  // each, some of the 194 steps of flight still count as held, because the low-pass lags.
  EXPECT_NEAR(model.seconds[index(Phase::right_only)], 4 * 0.006, 1e-9);
  EXPECT_GT(model.seconds[index(Phase::flight)], 4 * 0.170);
  EXPECT_LE(model.seconds[index(Phase::flight)], 4 * 0.194 + 1e-9);
  // 100 steps after the last landing the robot is hung up: from the middle on that is nearer.
  EXPECT_NEAR(model.seconds[index(Phase::impact_2)], 3 * 0.045 + 0.035, 1e-9);
  EXPECT_GT(model.seconds[index(Phase::held)], 0.45);
  EXPECT_GT(model.transition[index(Phase::flight)][index(Phase::impact_1)], 0.004);
}

TEST(PhaseModel, LabelsCarriedOnlyWhereForcesAreKnown) {
  const test::PhaseRun run = test::phase_run(2, 1);
  EXPECT_EQ(fit_phase_model(std::vector{run.view()}, 1000.0, test::small_phase_fit())
                .seconds[index(Phase::carried)],
            0.0);
  // Light wheels on the ground for the first 0.4 s.
  std::vector<double> force(run.signals.size(), 26.0);
  std::fill(force.begin(), force.begin() + 400, 5.0);
  PhaseFitRun view = run.view();
  view.normal_force = {force, force};
  const PhaseModel model = fit_phase_model(std::vector{view}, 1000.0, test::small_phase_fit());
  EXPECT_NEAR(model.seconds[index(Phase::carried)], 0.4, 0.03);
  view.may_be_held = false;
  EXPECT_EQ(fit_phase_model(std::vector{view}, 1000.0, test::small_phase_fit())
                .seconds[index(Phase::carried)],
            0.0);
}

TEST(PhaseModel, RefusesRunsThatItCannotBeFittedTo) {
  const PhaseFitConfig config = test::small_phase_fit();
  const test::PhaseRun run = test::phase_run(1, 1);
  PhaseFitRun view = run.view();
  view.contact[1] = view.contact[1].subspan(1);
  EXPECT_THROW(fit_phase_model(std::vector{view}, 1000.0, config), InputError);

  const std::vector<std::uint8_t> always(run.signals.size(), 1);
  view.contact = {WheelContact(always), WheelContact(always)};
  EXPECT_THROW(fit_phase_model(std::vector{view}, 1000.0, config), InputError);
  EXPECT_THROW(fit_phase_model({}, 1000.0, config), InputError);

  test::PhaseRun broken = run;
  broken.signals[10].leg[0].knee.torque = std::nan("");
  EXPECT_THROW(fit_phase_model(std::vector{broken.view()}, 1000.0, config), InputError);

  PhaseFitConfig bad = config;
  bad.torque_noise = {0.4, 0.1};
  EXPECT_THROW(fit_phase_model(std::vector{run.view()}, 1000.0, bad), InputError);
  EXPECT_THROW(fit_phase_model(std::vector{run.view()}, 0.0, config), InputError);
}

TEST(PhaseModel, IsCheckedBeforeUse) {
  PhaseModel model = test::small_phase_model();
  model.transition[2][3] += 0.1;
  EXPECT_THROW(check_phase_model(model), InputError);
  model = test::small_phase_model();
  model.torque[0].log_density.pop_back();
  EXPECT_THROW(check_phase_model(model), InputError);
  model = test::small_phase_model();
  model.acceleration[1].log_density[3] = HUGE_VALF;
  EXPECT_THROW(check_phase_model(model), InputError);
  model = test::small_phase_model();
  model.torque.pop_back();
  EXPECT_THROW(check_phase_model(model), InputError);
  model = test::small_phase_model();
  std::swap(model.torque[1], model.torque[2]);
  EXPECT_THROW(check_phase_model(model), InputError);
  model = test::small_phase_model();
  model.torque.clear();
  EXPECT_THROW(check_phase_model(model), InputError);
}

}  // namespace
}  // namespace touchdown
