#include <csignal>

#include <gtest/gtest.h>

#include "core/program.hpp"
#include "tests/core/child_process.hpp"

namespace touchdown {
namespace {

class Interrupt : public ::testing::TestWithParam<int> {};

TEST_P(Interrupt, RequestsAStopAndKillsTheSecondTime) {
  EXPECT_EQ(end_of([] {
              const std::atomic<bool>& stop = stop_on_interrupt();
              if (stop) return 1;
              ::raise(GetParam());
              return stop ? 7 : 2;
            }),
            7);
  EXPECT_EQ(end_of([] {
              stop_on_interrupt();
              ::raise(GetParam());
              ::raise(GetParam());
              return 0;
            }),
            -GetParam());
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

}  // namespace
}  // namespace touchdown
