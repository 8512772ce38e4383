#include "experiments/boosting/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <thread>
#include <vector>
#include <xgboost/c_api.h>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/boosting/estimator.hpp"
#include "experiments/boosting/inputs.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::experiments {
namespace {

/// Rows with the values of their features.
struct DrawnRows {
  std::vector<float> features;
  std::vector<float> is_contact;

  [[nodiscard]] BoostingRows binned() const { return experiments::binned(features, is_contact); }
  [[nodiscard]] WindowFeatures row(std::size_t i) const {
    WindowFeatures row{};
    std::copy_n(features.begin() + static_cast<std::ptrdiff_t>(i * window_features),
                window_features, row.begin());
    return row;
  }
};

/// Normal features, rounded to multiples of `step` if it is not 0; in contact with a probability
/// that rises with one of them.
DrawnRows drawn_rows(std::size_t count, float step = 0.0F) {
  DrawnRows rows;
  const std::vector<double> values = test::normals(count * window_features, 0.0, 1.0, 1);
  const std::vector<double> label_noise = test::normals(count, 0.0, 0.5, 2);
  rows.features.assign(values.begin(), values.end());
  for (float& value : rows.features) {
    if (step > 0.0F) value = step * std::round(value / step);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto feature = static_cast<double>(rows.features[i * window_features + 7]);
    rows.is_contact.push_back(feature + label_noise[i] > -0.8 ? 1.0F : 0.0F);
  }
  return rows;
}

const BoostingConfig quick = {.trees = 12, .depth = 3};

/// The logits that the library itself predicts for the same rows.
std::vector<float> margins_by_the_library(const DrawnRows& rows, float air_weight) {
  DMatrixHandle matrix = nullptr;
  XGDMatrixCreateFromMat(rows.features.data(), rows.is_contact.size(), window_features,
                         std::numeric_limits<float>::quiet_NaN(), &matrix);
  XGDMatrixSetFloatInfo(matrix, "label", rows.is_contact.data(), rows.is_contact.size());
  std::vector<float> weights(rows.is_contact.size(), 1.0F);
  for (std::size_t i = 0; i < rows.is_contact.size(); ++i) {
    if (rows.is_contact[i] == 0.0F) weights[i] = air_weight;
  }
  XGDMatrixSetFloatInfo(matrix, "weight", weights.data(), weights.size());
  BoosterHandle booster = nullptr;
  XGBoosterCreate(&matrix, 1, &booster);
  for (const auto& [name, value] : {std::pair{"objective", "binary:logistic"},
                                    {"base_score", "0.5"},
                                    {"tree_method", "hist"},
                                    {"nthread", "1"},
                                    {"max_depth", "3"},
                                    {"eta", "0.15"},
                                    {"min_child_weight", "20"}}) {
    XGBoosterSetParam(booster, name, value);
  }
  for (int i = 0; i < 12; ++i) XGBoosterUpdateOneIter(booster, i, matrix);
  constexpr int margin = 1;
  bst_ulong count = 0;
  const float* values = nullptr;
  XGBoosterPredict(booster, matrix, margin, 0, 0, &count, &values);
  std::vector<float> margins(values, values + count);
  XGBoosterFree(booster);
  XGDMatrixFree(matrix);
  return margins;
}

float air_weight_of(const DrawnRows& rows) {
  const auto contact =
      static_cast<double>(std::count(rows.is_contact.begin(), rows.is_contact.end(), 1.0F));
  return static_cast<float>(
      std::sqrt(contact / (static_cast<double>(rows.is_contact.size()) - contact)));
}

TEST(BoostingFit, EqualsThePredictionOfTheLibraryWhereEveryValueHasABin) {
  for (const float step : {0.04F, 0.1F, 0.5F, 3.0F}) {  // fewer than 256 values of each feature
    const DrawnRows rows = drawn_rows(3000, step);
    const BoostedTrees trees = fit_trees(rows.binned(), quick);
    EXPECT_EQ(trees.trees(), 12U);
    const float air_weight = air_weight_of(rows);
    const std::vector<float> margins = margins_by_the_library(rows, air_weight);
    ASSERT_EQ(margins.size(), rows.is_contact.size());
    for (std::size_t i = 0; i < margins.size(); ++i) {
      ASSERT_NEAR(trees.logit(rows.row(i)), margins[i] + std::log(air_weight), 1e-5) << step;
    }
  }
}

/// The mean log loss of the rows.
template <typename Logit>
double log_loss(const DrawnRows& rows, const Logit& logit) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.is_contact.size(); ++i) {
    const double z = logit(i);
    sum += std::log1p(std::exp(rows.is_contact[i] > 0.0F ? -z : z));
  }
  return sum / static_cast<double>(rows.is_contact.size());
}

TEST(BoostingFit, IsAsGoodAsTheLibraryWithBinsOfAnyValues) {
  const DrawnRows rows = drawn_rows(6000);
  const BoostedTrees trees = fit_trees(rows.binned(), quick);
  const float air_weight = air_weight_of(rows);
  const std::vector<float> margins = margins_by_the_library(rows, air_weight);
  const double own =
      log_loss(rows, [&](std::size_t i) { return static_cast<double>(trees.logit(rows.row(i))); });
  const double library = log_loss(
      rows, [&](std::size_t i) { return static_cast<double>(margins[i] + std::log(air_weight)); });
  EXPECT_NEAR(own, library, 0.01 * library);
}

TEST(BoostingFit, LearnsWhichFeatureIsInformative) {
  const BoostedTrees trees = fit_trees(drawn_rows(6000).binned(), quick);
  WindowFeatures features{};
  features[7] = 1.5F;
  EXPECT_GT(trees.logit(features), 1.0F);
  features[7] = -2.5F;
  EXPECT_LT(trees.logit(features), -0.5F);
}

TEST(BoostingFit, GivesTheSameTreesOnAllThreads) {
  const BoostingRows rows = drawn_rows(2000).binned();
  const BoostedTrees alone = fit_trees(rows, quick);
  std::array<BoostedTrees, 3> beside;
  std::vector<std::thread> threads;
  for (BoostedTrees& trees : beside) {
    threads.emplace_back([&] { trees = fit_trees(rows, quick); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const BoostedTrees& trees : beside) {
    EXPECT_EQ(trees.feature, alone.feature);
    EXPECT_EQ(trees.threshold, alone.threshold);
    EXPECT_EQ(trees.leaf, alone.leaf);
  }
}

TEST(BoostingFit, RefusesASingleClass) {
  BoostingRows rows = drawn_rows(100).binned();
  std::fill(rows.is_contact.begin(), rows.is_contact.end(), 1.0F);
  EXPECT_THROW(fit_trees(rows, quick), InputError);
  EXPECT_THROW(fit_trees({}, quick), InputError);
}

TEST(BoostingFit, StopsOnRequest) {
  struct Asked {};
  EXPECT_THROW(fit_trees(drawn_rows(500).binned(), quick, [] { throw Asked(); }), Asked);
}

/// A robot with load on its knees in every other second.
struct DrawnRun {
  std::vector<Signals> signals;
  std::vector<std::uint8_t> contact;

  explicit DrawnRun(std::uint32_t seed) {
    const std::vector<double> noise = test::normals(8000, 0.0, 0.05, seed);
    for (std::size_t k = 0; k < 4000; ++k) {
      const bool in_contact = k / 1000 % 2 == 0;
      Signals signals_now;
      signals_now.time = 1e-3 * static_cast<double>(k);
      for (std::size_t side = 0; side < 2; ++side) {
        signals_now.leg[side].knee.torque =
            (side == 0 ? 1.0 : -1.0) * (in_contact ? 1.3 : 0.0) + noise[2 * k + side];
      }
      signals_now.vertical_acceleration = in_contact ? 0.0 : -9.8;
      signals.push_back(signals_now);
      contact.push_back(in_contact ? 1 : 0);
    }
  }
  [[nodiscard]] LabelledRun view() const { return {signals, {contact, contact}, 1000.0, 0}; }
};

// Drawing the rows of many runs takes longer than a user waits for Ctrl-C.
TEST(BoostingRows, StopBeforeAnyPassThroughARun) {
  struct Asked {};
  const DrawnRun run(1);
  LabelledRun brief = run.view();  // contact and flight
  brief.signals = brief.signals.subspan(700, 600);
  for (auto& contact : brief.contact) contact = contact.subspan(700, 600);
  const std::vector<LabelledRun> runs = {brief, brief, brief};
  const int all = static_cast<int>(quick.passes * runs.size());
  for (int at = 0; at <= all; ++at) {
    int calls = 0;
    const auto draw = [&] {
      (void)boosting_rows<SignalWindow>(runs, quick, [&] {
        if (calls++ == at) throw Asked();
      });
    };
    if (at < all) {
      EXPECT_THROW(draw(), Asked) << at;
    } else {
      EXPECT_NO_THROW(draw());
      EXPECT_EQ(calls, all);
    }
  }
}

TEST(BoostedTreesEstimator, DetectsContactInUnseenRuns) {
  const DrawnRun seen(1);
  const std::vector<LabelledRun> runs = {seen.view()};
  BoostingConfig config = quick;
  config.rows = 20'000;
  BoostedTreesEstimator<SignalWindow> estimator(
      fit_trees(boosting_rows<SignalWindow>(runs, config), config), {});
  const DrawnRun other(2);
  std::size_t right = 0;
  for (std::size_t k = 0; k < other.signals.size(); ++k) {
    const Belief& belief = estimator.update(other.signals[k]);
    EXPECT_TRUE(belief.wheel[0].p_contact > 0.0 && belief.wheel[0].p_contact < 1.0);
    for (const WheelBelief& wheel : belief.wheel) right += wheel.contact == (other.contact[k] != 0);
  }
  EXPECT_GT(right, other.signals.size() * 2 * 99 / 100);
}

}  // namespace
}  // namespace touchdown::experiments
