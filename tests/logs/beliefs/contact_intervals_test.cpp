#include "logs/log/contact_intervals.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using ::testing::HasSubstr;

class Intervals : public ::testing::Test {
 protected:
  ContactIntervals read(const std::string& text) {
    return read_contact_intervals(folder_.write("a.csv", text));
  }
  const ScratchFolder folder_;
};

TEST_F(Intervals, AreReadInAnyOrderOfColumnsAndRows) {
  const ContactIntervals both = read("contact, start ,end\n1,2.5,3\n\n0,1,2\r\ntrue,-1,0.5\n");
  ASSERT_EQ(both.intervals.size(), 3U);
  EXPECT_EQ(both.intervals[0].start, -1.0);
  EXPECT_EQ(both.intervals[1].contact, (std::array<bool, 2>{false, false}));
  EXPECT_EQ(both.intervals[2].end, 3.0);
  const ContactIntervals each = read("start,end,right,left\n0,1,0,1\n");
  EXPECT_EQ(each.intervals[0].contact, (std::array<bool, 2>{true, false}));
}

TEST_F(Intervals, KeepHowSureAProgramWasOfThem) {
  const ContactIntervals proposed = read("start,end,left,right,sure\n1,2.5,1,0,0.625\n0,1,1,1,1\n");
  EXPECT_EQ(proposed.intervals[0].sure, 1.0);
  EXPECT_EQ(proposed.intervals[1].sure, 0.625);
  EXPECT_EQ(to_csv(proposed), "start,end,left,right,sure\n0,1,1,1,1.000\n1,2.5,1,0,0.625\n");
  const ContactIntervals by_hand = read("start,end,contact\n0,1,1\n");
  EXPECT_FALSE(by_hand.intervals[0].sure);
  EXPECT_EQ(to_csv(by_hand), "start,end,left,right\n0,1,1,1\n");
}

TEST_F(Intervals, HoldFromTheirStartUntilBeforeTheirEnd) {
  const ContactIntervals some = read("start,end,contact\n0,1,1\n1,2,0\n5,6,1\n");
  EXPECT_EQ(some.at(-0.001), nullptr);
  EXPECT_TRUE(some.at(0.0)->contact[0]);
  EXPECT_TRUE(some.at(0.999)->contact[1]);
  EXPECT_FALSE(some.at(1.0)->contact[0]);
  EXPECT_EQ(some.at(2.0), nullptr);
  EXPECT_NE(some.at(6.0), nullptr) << "the last one also at its end";
  EXPECT_EQ(some.at(6.001), nullptr);
  EXPECT_EQ(some.at(std::numeric_limits<double>::quiet_NaN()), nullptr);
}

/// Times of a log at 1 kHz, as sums, as products and as they are printed.
TEST_F(Intervals, AreWrittenToTheMicrosecondAndReadBackToTheSameSteps) {
  ContactIntervals written;
  double sum = 0.0;
  for (int k = 0; k < 30'000; ++k, sum += 0.001) {
    if (k % 3 == 0) written.intervals.push_back({sum, sum + 0.003, {k % 2 == 0, k % 4 == 0}});
  }
  const std::string text = to_csv(written);
  EXPECT_THAT(text, HasSubstr("\n26.838,26.841,1,0\n"));
  const ContactIntervals read_back = read(text);
  for (int k = 0; k < 30'000; ++k) {
    const std::array<bool, 2> expected = {k / 3 * 3 % 2 == 0, k / 3 * 3 % 4 == 0};
    const ContactInterval* const one = read_back.at(0.001 * k);
    ASSERT_NE(one, nullptr) << k;
    ASSERT_EQ(one->contact, expected) << k;
  }
  EXPECT_EQ(to_csv(read_back), text);
}

TEST_F(Intervals, ThatAreBegunMayBeNone) {
  EXPECT_TRUE(read_begun_intervals(folder_ / "none.csv").intervals.empty());
  const auto file = folder_.write("begun.csv", to_csv({}));
  EXPECT_TRUE(read_begun_intervals(file).intervals.empty());
  EXPECT_THROW((void)read_begun_intervals(folder_.write("b.csv", "start,end\n")), InputError);
}

TEST_F(Intervals, OfSeveralLogsAreAFileForEachOrNone) {
  const std::string file = folder_.write("a.csv", "start,end,contact\n0,1,1\n").string();
  EXPECT_TRUE(read_contact_intervals(std::vector<std::string>{}, 3).empty());
  EXPECT_EQ(read_contact_intervals({file, file}, 2).size(), 2U);
  EXPECT_THROW((void)read_contact_intervals(std::vector<std::string>{file}, 2), InputError);
}

TEST_F(Intervals, AreReadInReverse) {
  std::string reversed = "start,end,contact\n";
  for (int k = 3000; k > 0; --k) reversed += fmt::format("{},{}.5,{}\n", k, k, k % 2);
  const ContactIntervals read_back = read(reversed);
  ASSERT_EQ(read_back.intervals.size(), 3000U);
  for (std::size_t k = 0; k < 3000; ++k) {
    ASSERT_EQ(read_back.intervals[k].start, static_cast<double>(k + 1));
    ASSERT_EQ(read_back.intervals[k].contact[0], (k + 1) % 2 == 1);
  }
}

}  // namespace
}  // namespace touchdown::logs
