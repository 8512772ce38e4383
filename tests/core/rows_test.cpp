#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/rows.hpp"

namespace touchdown {
namespace {

using ::testing::ElementsAre;

struct Score {
  std::string engine;
  std::string estimator;
  int value = 0;
};

const std::vector<Score> scores = {
    {"mujoco", "phase", 1}, {"bullet", "phase", 2}, {"mujoco", "bayes", 3}, {"mujoco", "phase", 4}};

std::string text_of(const Score& score) { return std::to_string(score.value); }

TEST(Unique, KeepsTheOrderOfFirstAppearance) {
  EXPECT_THAT(unique(scores, &Score::engine), ElementsAre("mujoco", "bullet"));
  EXPECT_THAT(unique(scores, [](const Score& score) { return score.value % 2; }),
              ElementsAre(1, 0));
  EXPECT_TRUE(unique(std::vector<Score>(), &Score::engine).empty());
}

TEST(Where, KeepsTheRowsThatMeetThePredicate) {
  const auto found = where(scores, [](const Score& score) { return score.engine == "mujoco"; });
  EXPECT_THAT(unique(found, &Score::value), ElementsAre(1, 3, 4));
}

TEST(GroupBy, CollectsInterleavedRowsInOrder) {
  const auto groups = group_by(scores, &Score::estimator);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].key, "phase");
  EXPECT_THAT(unique(groups[0].rows, &Score::value), ElementsAre(1, 2, 4));
  EXPECT_EQ(groups[1].key, "bayes");
  EXPECT_THAT(unique(groups[1].rows, &Score::value), ElementsAre(3));
}

TEST(Pivot, PutsADashWhereNoRowIs) {
  const std::vector<Score> without_repetition(scores.begin(), scores.begin() + 3);
  const Table table = pivot(without_repetition, &Score::estimator, &Score::engine, text_of);
  EXPECT_THAT(table.header, ElementsAre("", "mujoco", "bullet"));
  EXPECT_THAT(table.rows,
              ElementsAre(ElementsAre("phase", "1", "2"), ElementsAre("bayes", "3", "–")));
}

}  // namespace
}  // namespace touchdown
