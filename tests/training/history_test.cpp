#include "apps/training/history.hpp"

#include <fstream>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::training {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TrainingHistory history(const std::vector<double>& validation) {
  TrainingHistory records;
  for (const double loss : validation) {
    const int n = static_cast<int>(records.size()) + 1;
    records.push_back({n, 800.0 * n, {0.1 / 3.0, 1e-17, loss / 7.0, 0.9}, {loss, 0.0, loss, 0.95}});
  }
  return records;
}

TEST(TrainingHistory, ChoosesTheFirstOfTheBest) {
  EXPECT_EQ(best_iteration(history({3.0, 1.0, 2.0, 1.0})), 1U);
  EXPECT_EQ(best_iteration(history({1.0})), 0U);
}

TEST(TrainingHistory, StopsAfterThePatience) {
  EXPECT_FALSE(stopped_improving({}, 1));
  EXPECT_FALSE(stopped_improving(history({2.0, 1.0}), 1));
  EXPECT_FALSE(stopped_improving(history({1.0, 2.0}), 2));
  EXPECT_TRUE(stopped_improving(history({1.0, 2.0, 3.0}), 2));
  EXPECT_TRUE(stopped_improving(history({1.0, 1.0, 1.0}), 2));
}

class HistoryFile : public testing::Test {
 protected:
  void expect_complaint(const std::string& text, const char* place) {
    std::ofstream(path_) << text;
    EXPECT_THAT([&] { read_history(path_); }, ThrowsMessage<InputError>(HasSubstr(place)));
  }
  const ScratchFolder scratch_;
  const std::filesystem::path path_ = scratch_ / "history.csv";
};

TEST_F(HistoryFile, ReadsBackToTheBit) {
  const TrainingHistory written = history({1.0 / 3.0, 0.1});
  write_history(written, path_);
  const TrainingHistory read = read_history(path_);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].iteration, 2);
  EXPECT_EQ(read[1].data_seconds, 1600.0);
  EXPECT_EQ(read[0].training.contact, written[0].training.contact);
  EXPECT_EQ(read[0].training.velocity, written[0].training.velocity);
  EXPECT_EQ(read[0].training.total, written[0].training.total);
  EXPECT_EQ(read[0].validation.total, written[0].validation.total);
  EXPECT_EQ(read[0].validation.accuracy, written[0].validation.accuracy);
}

TEST_F(HistoryFile, NamesTheWrongLine) {
  write_history(history({1.0, 2.0}), path_);
  std::ifstream file(path_);
  const std::string good((std::istreambuf_iterator<char>(file)), {});
  expect_complaint("x\n", "csv:1: ");
  expect_complaint(good + "3,4\n", "csv:4: ");
  expect_complaint(good.substr(0, good.size() / 2), "csv:");
  const std::size_t header_end = good.find('\n') + 1;
  expect_complaint(good.substr(0, header_end) + good.substr(good.find('\n', header_end) + 1),
                   "csv:2: ");
}

}  // namespace
}  // namespace touchdown::training
