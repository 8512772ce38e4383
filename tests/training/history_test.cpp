#include "apps/training/history.hpp"

#include <map>

#include <gmock/gmock.h>

#include "core/files.hpp"
#include "tests/complaint.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::training {
namespace {

using testing::HasSubstr;

TrainingHistory history(const std::vector<double>& validation) {
  TrainingHistory records;
  for (const double loss : validation) {
    const int n = static_cast<int>(records.size()) + 1;
    records.push_back({n, 800.0 * n, {0.1 / 3.0, 1e-17, loss / 7.0, 0.9}, {loss, 0.0, loss, 0.95}});
  }
  return records;
}

TEST(TrainingHistory, ChoosesTheFirstOfTheBestAndStopsAfterThePatience) {
  EXPECT_EQ(best_iteration(history({3.0, 1.0, 2.0, 1.0})), 1U);
  EXPECT_EQ(best_iteration(history({1.0})), 0U);
  EXPECT_FALSE(stopped_improving({}, 1));
  EXPECT_FALSE(stopped_improving(history({2.0, 1.0}), 1));
  EXPECT_FALSE(stopped_improving(history({1.0, 2.0}), 2));
  EXPECT_TRUE(stopped_improving(history({1.0, 2.0, 3.0}), 2));
  EXPECT_TRUE(stopped_improving(history({1.0, 1.0, 1.0}), 2));
}

TEST(TrainingHistory, ReadsBackToTheBitAndNamesAWrongLine) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder / "history.csv";
  const TrainingHistory written = history({1.0 / 3.0, 0.1});
  write_history(written, path);
  const TrainingHistory read = read_history(path);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].iteration, 2);
  EXPECT_EQ(read[1].data_seconds, 1600.0);
  EXPECT_EQ(read[0].training.contact, written[0].training.contact);
  EXPECT_EQ(read[0].training.velocity, written[0].training.velocity);
  EXPECT_EQ(read[0].validation.total, written[0].validation.total);
  EXPECT_EQ(read[0].validation.accuracy, written[0].validation.accuracy);

  const std::string good = read_file(path);
  const std::size_t first = good.find('\n') + 1;
  const std::size_t second = good.find('\n', first) + 1;
  for (const auto& [text, place] : std::map<std::string, const char*>{
           {"x\n", "csv:1: "},
           {good + "3,4\n", "csv:4: "},
           {good.substr(0, good.size() / 2), "csv:"},
           {good.substr(0, first) + good.substr(second), "csv:2: "}}) {
    folder.write("history.csv", text);
    EXPECT_THAT(complaint_of([&] { read_history(path); }), HasSubstr(place));
  }
}

}  // namespace
}  // namespace touchdown::training
