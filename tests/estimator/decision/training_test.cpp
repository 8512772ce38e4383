#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/decision/fit.hpp"
#include "tests/estimator/decision/decision_logit.hpp"
#include "tests/estimator/decision/random_model.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::decision_logit;

/// Rows with random labels of P(contact) = 1 / (1 + exp(−logit)), a function of the inputs.
struct Coins {
  DecisionRows rows;
  std::vector<double> p;
};

Coins coins(int count, double steepness, double offset, std::uint32_t seed) {
  test::Normal normal(seed);
  Coins all;
  all.rows.inputs.resize(static_cast<int>(decision_inputs), count);
  all.rows.is_contact.resize(count);
  all.rows.weight = Eigen::RowVectorXf::Ones(count);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < static_cast<int>(decision_inputs); ++k) {
      all.rows.inputs(k, i) = static_cast<float>(normal());
    }
    const double logit =
        offset + steepness * (all.rows.inputs(0, i) - std::abs(all.rows.inputs(7, i)));
    all.p.push_back(1.0 / (1.0 + std::exp(-logit)));
    const double coin = 0.5 * std::erfc(-normal() / std::sqrt(2.0));
    all.rows.is_contact[i] = coin < all.p.back() ? 1.0F : 0.0F;
  }
  return all;
}

/// All numbers of a model, one after the other.
std::vector<double> numbers_of(const DecisionModel& model) {
  std::vector<double> all(model.first_weight.begin(), model.first_weight.end());
  all.insert(all.end(), model.first_bias.begin(), model.first_bias.end());
  all.insert(all.end(), model.second_weight.begin(), model.second_weight.end());
  all.insert(all.end(), model.second_bias.begin(), model.second_bias.end());
  all.insert(all.end(), model.last_weight.begin(), model.last_weight.end());
  all.push_back(model.last_bias);
  return all;
}

/// The loss by its definition, row by row, in double precision.
double loss_of(const std::vector<double>& numbers, const DecisionRows& rows) {
  double sum = 0.0;
  double weights = 0.0;
  for (Eigen::Index row = 0; row < rows.inputs.cols(); ++row) {
    std::vector<double> x;
    for (Eigen::Index i = 0; i < rows.inputs.rows(); ++i) x.push_back(rows.inputs(i, row));
    std::size_t next = 0;
    for (const std::size_t outputs : {decision_first, decision_second, std::size_t{1}}) {
      std::vector<double> y(outputs);
      for (std::size_t k = 0; k < outputs; ++k) {
        y[k] = numbers[next + x.size() * outputs + k];
        for (std::size_t i = 0; i < x.size(); ++i) y[k] += numbers[next + i * outputs + k] * x[i];
        if (outputs > 1) y[k] = std::max(y[k], 0.0);
      }
      next += (x.size() + 1) * outputs;
      x = y;
    }
    const double p = 1.0 / (1.0 + std::exp(-x[0]));
    sum -= rows.weight[row] * std::log(rows.is_contact[row] > 0.0F ? p : 1.0 - p);
    weights += rows.weight[row];
  }
  return sum / weights;
}

DecisionRows weighted_coins() {
  DecisionRows rows = coins(40, 2.0, 0.3, 2).rows;
  for (Eigen::Index i = 0; i < rows.weight.size(); ++i) {
    rows.weight[i] = 1.0F + static_cast<float>(i % 3);
  }
  return rows;
}

TEST(DecisionLoss, IsTheWeightedCrossEntropy) {
  const DecisionModel model = test::random_model(1);
  const DecisionRows rows = weighted_coins();
  EXPECT_NEAR(decision_loss(model, rows), loss_of(numbers_of(model), rows), 1e-5);
}

TEST(DecisionLoss, HasTheGradientOfItsFiniteDifferences) {
  const DecisionModel model = test::random_model(3);
  const DecisionRows rows = weighted_coins();
  DecisionModel gradient;
  static_cast<void>(decision_loss(model, rows, &gradient));
  const std::vector<double> found = numbers_of(gradient);
  const std::vector<double> numbers = numbers_of(model);
  double largest = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool is_behind_inputs = i >= decision_inputs * decision_first;
    if (!is_behind_inputs && i % 13 != 0) continue;  // a sample of the many
    constexpr double step = 1e-6;
    std::vector<double> moved = numbers;
    moved[i] += step;
    const double up = loss_of(moved, rows);
    moved[i] -= 2.0 * step;
    const double expected = (up - loss_of(moved, rows)) / (2.0 * step);
    ASSERT_NEAR(found[i], expected, 1e-6) << i;
    largest = std::max(largest, std::abs(expected));
  }
  EXPECT_GT(largest, 0.01);
}

TEST(DecisionTraining, FindsTheProbabilityOfABiasedCoin) {
  const Coins fitted = coins(40'000, 3.0, 1.0, 5);
  const DecisionModel model = train_decision_model(fitted.rows, {.batch = 256, .epochs = 10});
  const Coins others = coins(4000, 3.0, 1.0, 6);
  double found = 0.0;
  double best = 0.0;
  double error = 0.0;
  for (Eigen::Index i = 0; i < others.rows.inputs.cols(); ++i) {
    DecisionInputs inputs;
    std::copy_n(others.rows.inputs.col(i).data(), decision_inputs, inputs.begin());
    const double p = 1.0 / (1.0 + std::exp(-static_cast<double>(decision_logit(model, inputs))));
    const double truth = others.p[static_cast<std::size_t>(i)];
    const bool contact = others.rows.is_contact[i] > 0.0F;
    found -= std::log(contact ? p : 1.0 - p);
    best -= std::log(contact ? truth : 1.0 - truth);
    error += p - truth;
  }
  const double count = static_cast<double>(others.p.size());
  EXPECT_LT(found / count, best / count + 0.03);
  EXPECT_NEAR(error / count, 0.0, 0.02);
}

TEST(DecisionTraining, RepeatsItselfToTheBit) {
  const DecisionRows rows = coins(2000, 3.0, 0.0, 7).rows;
  const DecisionFitConfig config{.batch = 64, .epochs = 2};
  const DecisionModel once = train_decision_model(rows, config);
  EXPECT_EQ(train_decision_model(rows, config), once);
  DecisionFitConfig other = config;
  other.seed = 2;
  EXPECT_FALSE(train_decision_model(rows, other) == once);
}

TEST(DecisionLoss, TreatsTheServoLoadAsOneMoreInput) {
  // With the first inputs once more as the servo load, its weights add to theirs.
  constexpr std::size_t count = 2 * decision_scales;
  test::Normal normal(8);
  DecisionModel model = test::random_model(4);
  model.servo_weight.resize(servo_weights);
  for (float& weight : model.servo_weight) weight = static_cast<float>(0.3 * normal());
  DecisionModel sum = model;
  sum.servo_weight.clear();
  for (std::size_t i = 0; i < servo_weights; ++i) sum.first_weight[i] += model.servo_weight[i];
  const DecisionRows rows = weighted_coins();
  DecisionRows twice = rows;
  twice.servo = rows.inputs.topRows(static_cast<int>(count));
  DecisionModel found;
  found.servo_weight.resize(servo_weights);
  DecisionModel expected;
  EXPECT_NEAR(decision_loss(model, twice, &found), decision_loss(sum, rows, &expected), 1e-5);
  float largest = 0.0F;
  for (std::size_t i = 0; i < servo_weights; ++i) {
    ASSERT_NEAR(found.servo_weight[i], expected.first_weight[i], 1e-5F) << i;
    ASSERT_NEAR(found.first_weight[i], expected.first_weight[i], 1e-5F) << i;
    largest = std::max(largest, std::abs(found.servo_weight[i]));
  }
  EXPECT_GT(largest, 0.01F);
  DecisionInputs inputs;
  std::copy_n(rows.inputs.col(3).data(), inputs.size(), inputs.begin());
  ServoLoadInputs servo;
  std::copy_n(inputs.begin(), count, servo.begin());
  EXPECT_NEAR(decision_logit(model, inputs, servo), decision_logit(sum, inputs), 1e-3F);
}

TEST(DecisionTraining, LearnsFromTheServoLoadWhatNoOtherInputShows) {
  test::Normal normal(9);
  DecisionRows rows = coins(20'000, 0.0, 0.0, 10).rows;
  rows.servo.resize(static_cast<int>(2 * decision_scales), rows.inputs.cols());
  for (Eigen::Index row = 0; row < rows.servo.cols(); ++row) {
    for (Eigen::Index i = 0; i < rows.servo.rows(); ++i) {
      rows.servo(i, row) = static_cast<float>(normal());
    }
    rows.is_contact[row] = rows.servo(2, row) > 0.0F ? 1.0F : 0.0F;
  }
  const DecisionModel model = train_decision_model(rows, {.batch = 256, .epochs = 8});
  ServoLoadInputs loaded{};
  ServoLoadInputs unloaded{};
  loaded[2] = 1.5F;
  unloaded[2] = -1.5F;
  EXPECT_GT(decision_logit(model, {}, loaded), 2.0F);
  EXPECT_LT(decision_logit(model, {}, unloaded), -2.0F);
}

}  // namespace
}  // namespace touchdown
