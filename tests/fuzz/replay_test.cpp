#include <algorithm>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

namespace {

namespace fs = std::filesystem;

class Corpus : public ::testing::TestWithParam<Target> {};

/// Inputs of the corpus cause no errors; under sanitizers, more are found.
TEST_P(Corpus, IsReplayed) {
  const fs::path folder = fs::path(TOUCHDOWN_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  ASSERT_GE(files.size(), 2U) << folder;
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const std::string content = read_file(file);
    const std::clock_t start = std::clock();  // processor time: other processes do not count
    EXPECT_NO_THROW(call(GetParam(), content));
    EXPECT_LT(std::clock() - start, 20 * CLOCKS_PER_SEC);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Corpus, ::testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace touchdown::fuzz
