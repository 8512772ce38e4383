#include "experiments/results/odometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

TEST(ContactSources, RepeatTheLabelsWithAndWithoutDelay) {
  RunSignals run;
  run.info.control_period_us = 10'000;
  run.signals.resize(6);
  run.contact = {scoring::ContactSequence{0, 1, 1, 0, 0, 1},
                 scoring::ContactSequence{1, 1, 0, 0, 1, 1}};
  const std::vector<double> config{0.02};
  EXPECT_THAT(oracle_names(config), ElementsAre("truth", "truth_delayed_20ms"));
  const std::vector<ContactTrack> tracks = oracle_tracks(config, run);
  ASSERT_EQ(tracks.size(), 2U);
  EXPECT_THAT(tracks[0][0], ElementsAre(0, 1, 1, 0, 0, 1));
  EXPECT_THAT(tracks[0][1], ElementsAre(1, 1, 0, 0, 1, 1));
  EXPECT_THAT(tracks[1][0], ElementsAre(1, 1, 0, 1, 1, 0));
  EXPECT_THAT(tracks[1][1], ElementsAre(1, 1, 1, 1, 0, 0));
}

TEST(ContactSources, HaveTitlesThatMarkOracles) {
  EXPECT_EQ(contact_title("truth"), "Truth (oracle)");
  EXPECT_EQ(contact_title("truth_delayed_2.5ms"), "Truth, delayed 2.5 ms (oracle)");
  EXPECT_EQ(contact_title("always"), "Always contact");
  EXPECT_EQ(contact_title("load_filter"), "Load filter");
  EXPECT_EQ(contact_name("always_contact"), "always");
  EXPECT_EQ(contact_name("load_filter"), "load_filter");
}

}  // namespace
}  // namespace touchdown::experiments
