#include "experiments/batch/phase_recursion.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/estimator/random.hpp"

namespace touchdown::experiments {
namespace {

/// Probabilities of a few phases after each; all others have the same share of `rest`.
PhaseRecursion recursion(test::Normal& normal, std::size_t likely, double rest) {
  PhaseModel model;
  for (std::size_t i = 0; i < phase_count; ++i) {
    model.transition[i].fill(rest / phase_count);
    std::array<double, phase_count> weight{};
    double sum = 0.0;
    for (std::size_t k = 0; k < likely; ++k) {
      weight[(i + k) % phase_count] = std::abs(normal()) + 0.01;
      sum += weight[(i + k) % phase_count];
    }
    for (std::size_t j = 0; j < phase_count; ++j) {
      model.transition[i][j] += (1.0 - rest) * weight[j] / sum;
    }
  }
  return {model, 1};
}

std::vector<PhaseRow> rows(test::Normal& normal, std::size_t levels, double spread) {
  std::vector<PhaseRow> result(levels);
  for (PhaseRow& row : result) {
    for (float& x : row) x = static_cast<float>(spread * normal());
  }
  return result;
}

/// A batch and one recursion per element, for some steps.
void expect_equal(const PhaseRecursion& one, std::size_t elements, double torque_spread,
                  double acceleration_spread, const std::string& what) {
  constexpr std::size_t torques = 5;
  constexpr std::size_t accelerations = 3;
  std::vector<std::uint32_t> torque_level;
  std::vector<std::uint32_t> acceleration_level;
  for (std::size_t i = 0; i < elements; ++i) {
    torque_level.push_back(static_cast<std::uint32_t>(i * 7 % torques));
    acceleration_level.push_back(static_cast<std::uint32_t>(i * i % accelerations));
  }
  BatchedPhaseRecursion batch(one, torque_level, acceleration_level);
  PhaseLikelihoods torque(torques);
  PhaseLikelihoods acceleration(accelerations);
  std::vector<PhaseRecursion::Lanes> expected(elements, PhaseRecursion::prior);
  test::Normal normal(11);
  for (int step = 0; step < 60; ++step) {
    const std::vector<PhaseRow> first = rows(normal, torques, torque_spread);
    const std::vector<PhaseRow> second = rows(normal, accelerations, acceleration_spread);
    for (std::size_t i = 0; i < torques; ++i) torque.set(i, first[i]);
    for (std::size_t i = 0; i < accelerations; ++i) acceleration.set(i, second[i]);
    torque.update();
    acceleration.update();
    batch.update(torque, acceleration);
    ASSERT_EQ(batch.blocks().size(), (elements + batch_width - 1) / batch_width);
    for (std::size_t i = 0; i < elements; ++i) {
      PhaseRecursion::Lanes evidence;
      for (std::size_t k = 0; k < phase_count; ++k) {
        evidence[k] =
            static_cast<double>(first[torque_level[i]][k] + second[acceleration_level[i]][k]);
      }
      one.predict_and_correct(expected[i], evidence);
      for (std::size_t k = 0; k < phase_count; ++k) {
        ASSERT_NEAR(batch.blocks()[i / batch_width].value[k][i % batch_width], expected[i][k],
                    1e-12)
            << what << ": element " << i << " of " << elements << ", step " << step;
      }
    }
  }
}

TEST(BatchedPhaseRecursion, EqualsSingleOnesForAnyTransitionsAndSizes) {
  test::Normal normal(5);
  for (const std::size_t likely : {1U, 2U, 5U, 12U}) {
    for (const double rest : {0.0, 1e-9, 0.01, 1.0}) {
      const PhaseRecursion one = recursion(normal, likely, rest);
      for (const std::size_t elements : {1U, 7U, 8U, 9U, 64U, 241U}) {
        expect_equal(one, elements, 3.0, 2.0, std::to_string(likely));
      }
    }
  }
}

// Likelihoods with a product below the smallest double, and those without an exponential.
TEST(BatchedPhaseRecursion, EqualsSingleOnesWhereEvidenceIsExtreme) {
  test::Normal normal(6);
  const PhaseRecursion one = recursion(normal, 3, 0.01);
  for (const double torque : {1.0, 60.0, 110.0, 250.0, 1000.0, 1e6}) {
    for (const double acceleration : {0.0, 1.0, 90.0, 300.0, 1e5}) {
      expect_equal(one, 21, torque, acceleration,
                   std::to_string(torque) + " " + std::to_string(acceleration));
    }
  }
}

}  // namespace
}  // namespace touchdown::experiments
