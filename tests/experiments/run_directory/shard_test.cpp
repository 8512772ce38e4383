#include "experiments/run_directory/shard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown::experiments {
namespace {

TEST(Shard, SharesMeetWithoutGapOrOverlap) {
  for (const std::size_t size : {0U, 1U, 2U, 7U, 320U}) {
    for (const int count : {1, 2, 3, 8, 400}) {
      std::size_t next = 0;
      for (int index = 1; index <= count; ++index) {
        const Shard shard{index, count};
        EXPECT_EQ(shard.begin(size), next);
        EXPECT_LE(shard.end(size) - shard.begin(size), size / static_cast<std::size_t>(count) + 1);
        next = shard.end(size);
      }
      EXPECT_EQ(next, size);
    }
  }
}

TEST(Shard, IsReadAndWritten) {
  EXPECT_EQ(shard_from("2/3"), (Shard{2, 3}));
  EXPECT_EQ(to_text(shard_from("17/170")), "17/170");
}

TEST(Shard, RefusesWhatIsNone) {
  for (const char* text : {"", "/", "1", "1/", "/3", "0/3", "4/3", "-1/3", "1/0", "a/b", "1/3x",
                           "1/3/4", " 1/3", "1.5/3", "1/99999999999", "1/200000"}) {
    EXPECT_THROW(shard_from(text), InputError) << text;
  }
}

}  // namespace
}  // namespace touchdown::experiments
