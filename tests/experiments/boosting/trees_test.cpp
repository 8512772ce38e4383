#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/boosting/estimator.hpp"

namespace touchdown::experiments {
namespace {

/// x₃ < 1 ? (x₀ < 0 ? 1 : 2) : (x₄ < 5 ? 4 : 8), nine times.
BoostedTrees nine_equal_trees() {
  BoostedTrees trees{.depth = 2, .bias = 0.5F};
  for (int i = 0; i < 9; ++i) {
    trees.feature.insert(trees.feature.end(), {3, 0, 4});
    trees.threshold.insert(trees.threshold.end(), {1.0F, 0.0F, 5.0F});
    trees.leaf.insert(trees.leaf.end(), {1.0F, 2.0F, 4.0F, 8.0F});
  }
  return trees;
}

TEST(BoostedTrees, AddTheReachedLeaves) {
  const BoostedTrees trees = nine_equal_trees();
  std::array<float, 5> features{};
  features[0] = -1.0F;
  EXPECT_EQ(trees.logit(features), 9.5F);
  features[0] = 0.0F;  // not below
  EXPECT_EQ(trees.logit(features), 18.5F);
  features[3] = 1.0F;
  EXPECT_EQ(trees.logit(features), 36.5F);
  features[4] = 6.0F;
  EXPECT_EQ(trees.logit(features), 72.5F);
}

TEST(BoostedTrees, AreRefusedUnlessComplete) {
  EXPECT_NO_THROW(check_trees(nine_equal_trees(), 5));
  EXPECT_THROW(check_trees({}, 5), InputError);
  const auto refused = [](const auto& change) {
    BoostedTrees trees = nine_equal_trees();
    change(trees);
    EXPECT_THROW(check_trees(trees, 5), InputError);
  };
  refused([](BoostedTrees& trees) { trees.leaf.pop_back(); });
  refused([](BoostedTrees& trees) { trees.feature.pop_back(); });
  refused([](BoostedTrees& trees) { trees.feature[5] = 5; });
  refused([](BoostedTrees& trees) { trees.depth = 40; });
  constexpr float infinity = std::numeric_limits<float>::infinity();
  refused([](BoostedTrees& trees) { trees.threshold[1] = infinity; });
  refused([](BoostedTrees& trees) { trees.leaf[1] = infinity; });
  refused([](BoostedTrees& trees) { trees.bias = infinity; });
}

}  // namespace
}  // namespace touchdown::experiments
