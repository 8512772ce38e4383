#include "estimator/phase/labels.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown {
namespace {

using Contact = std::vector<std::uint8_t>;

/// At 1 kHz: contact except in the given intervals [begin, end).
Contact contact_but(std::size_t steps,
                    const std::vector<std::pair<std::size_t, std::size_t>>& off) {
  Contact contact(steps, 1);
  for (const auto& [begin, end] : off) {
    std::fill(contact.begin() + static_cast<int>(begin), contact.begin() + static_cast<int>(end),
              std::uint8_t{0});
  }
  return contact;
}

std::vector<Phase> labels(const Contact& left, const Contact& right, const Contact& held = {},
                          const Contact& carried = {}) {
  PhaseLabelConfig config;
  config.unloading = {0.100, 0.040, 0.015};
  config.impact = {0.015, 0.060, 0.150};
  return label_phases({WheelContact(left), WheelContact(right)}, held, 1000.0, config, carried);
}

TEST(PhaseLabels, FollowTheClockAroundAFlight) {
  const Contact both = contact_but(1000, {{300, 500}});
  const std::vector<Phase> phases = labels(both, both);
  // Step k is 300 − k steps before the takeoff, k − 499 steps after the landing.
  const auto expect = [&](std::size_t begin, std::size_t end, Phase phase) {
    for (std::size_t k = begin; k < end; ++k) EXPECT_EQ(phases[k], phase) << "step " << k;
  };
  expect(0, 200, Phase::rolling);
  expect(200, 260, Phase::unloading_1);
  expect(260, 285, Phase::unloading_2);
  expect(285, 300, Phase::unloading_3);
  expect(300, 500, Phase::flight);
  expect(500, 515, Phase::impact_1);
  expect(515, 560, Phase::impact_2);
  expect(560, 650, Phase::impact_3);
  expect(650, 1000, Phase::rolling);
}

TEST(PhaseLabels, DistinguishTheWheels) {
  const std::vector<Phase> phases =
      labels(contact_but(600, {{300, 400}}), contact_but(600, {{330, 380}}));
  EXPECT_EQ(phases[299], Phase::unloading_3);
  EXPECT_EQ(phases[300], Phase::right_only);
  EXPECT_EQ(phases[329], Phase::right_only);
  EXPECT_EQ(phases[330], Phase::flight);
  EXPECT_EQ(phases[380], Phase::right_only);
  EXPECT_EQ(phases[399], Phase::right_only);
  EXPECT_EQ(phases[400], Phase::impact_1);
}

TEST(PhaseLabels, IgnoreShortFlights) {
  const Contact short_hop = contact_but(500, {{200, 219}});
  for (const Phase phase : labels(short_hop, short_hop)) EXPECT_EQ(phase, Phase::rolling);
  const Contact hop = contact_but(500, {{200, 220}});
  EXPECT_EQ(labels(hop, hop)[210], Phase::flight);
}

TEST(PhaseLabels, GoByTheNearerEventBetweenTwoFlights) {
  const Contact both = contact_but(400, {{100, 200}, {240, 340}});
  const std::vector<Phase> phases = labels(both, both);
  EXPECT_EQ(phases[200], Phase::impact_1);     // 1 step after, 40 before
  EXPECT_EQ(phases[218], Phase::impact_2);     // 19 after, 22 before
  EXPECT_EQ(phases[219], Phase::impact_2);     // 20 after, 21 before
  EXPECT_EQ(phases[220], Phase::unloading_2);  // 21 after, 20 before
  EXPECT_EQ(phases[239], Phase::unloading_3);
}

TEST(PhaseLabels, LabelARobotThatDoesNotFallAsHeld) {
  const Contact both = contact_but(300, {{100, 300}});
  Contact held(300, 0);
  std::fill(held.begin() + 200, held.end(), std::uint8_t{1});
  const std::vector<Phase> phases = labels(both, both, held);
  EXPECT_EQ(phases[150], Phase::flight);
  EXPECT_EQ(phases[250], Phase::held);
  EXPECT_EQ(phases[50], Phase::unloading_1);  // on the ground, `held` has no effect
}

TEST(PhaseLabels, HeldIsFarFromFreeFall) {
  std::vector<Signals> signals(1000);
  for (std::size_t k = 0; k < 500; ++k) signals[k].vertical_acceleration = -9.81;
  const std::vector<std::uint8_t> held = held_steps(signals, 1000.0, {});
  EXPECT_EQ(held[0], 0);
  EXPECT_EQ(held[499], 0);
  // The step response of the low-pass (1/50 per step) crosses 3 of 9.81 at the 19th step:
  // 9.81·(1 − 0.98^n) > 3 first at n = 19.
  EXPECT_EQ(held[517], 0);
  EXPECT_EQ(held[518], 1);
  EXPECT_EQ(held[999], 1);
}

TEST(PhaseLabels, LabelLightContactWithoutFallingAsCarried) {
  // A hand takes the weight off both wheels at step 100, and off the ground at step 200.
  const Contact both = contact_but(400, {{200, 300}});
  Contact held(400, 1);
  std::fill(held.begin() + 300, held.end(), std::uint8_t{0});
  std::vector<double> left(400, 26.0);
  std::fill(left.begin() + 100, left.end(), 3.0);
  const std::vector<double> right = left;
  const Contact carried = carried_steps({left, right}, held, 1000.0, {});
  // 52 N fall towards 6 N by a twentieth per step: 6 + 46·0.95^n < 40 first at n = 6.
  EXPECT_EQ(carried[104], 0);
  EXPECT_EQ(carried[105], 1);
  EXPECT_EQ(carried[299], 1);
  EXPECT_EQ(carried[300], 0);  // light wheels of a falling robot are not carried
  const std::vector<Phase> phases = labels(both, both, held, carried);
  EXPECT_EQ(phases[104], Phase::unloading_1);
  EXPECT_EQ(phases[105], Phase::carried);
  EXPECT_EQ(phases[199], Phase::carried);
  EXPECT_EQ(phases[200], Phase::held);
  EXPECT_EQ(phases[300], Phase::impact_1);
}

TEST(PhaseLabels, TakeEmptyRunsAndRefuseUnequalOnes) {
  EXPECT_TRUE(labels({}, {}).empty());
  EXPECT_THROW(labels(Contact(3, 1), Contact(4, 1)), InputError);
  EXPECT_THROW(labels(Contact(3, 1), Contact(3, 1), Contact(2, 0)), InputError);
  EXPECT_THROW(labels(Contact(3, 1), Contact(3, 1), Contact(3, 0), Contact(4, 0)), InputError);
  EXPECT_TRUE(carried_steps({}, {}, 1000.0, {}).empty());
  const std::vector<double> force(2, 1.0);
  EXPECT_THROW(carried_steps({force, force}, Contact(3, 1), 1000.0, {}), InputError);
  PhaseLabelConfig config;
  config.unloading = {0.01, 0.02, 0.03};
  EXPECT_THROW(check_phase_labels(config), InputError);
}

}  // namespace
}  // namespace touchdown
