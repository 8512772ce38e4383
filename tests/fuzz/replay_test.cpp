#include <algorithm>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/files.hpp"

namespace touchdown::fuzz {

void fuzz_beliefs(std::string_view input);
void fuzz_cdr(std::string_view input);
void fuzz_log(std::string_view input);
void fuzz_mapping(std::string_view input);
void fuzz_mcap(std::string_view input);
void fuzz_measurement_model(std::string_view input);
void fuzz_mjcf(std::string_view input);
void fuzz_neural_network(std::string_view input);
void fuzz_npy(std::string_view input);
void fuzz_npz(std::string_view input);
void fuzz_parameter_model(std::string_view input);
void fuzz_phase_model(std::string_view input);
void fuzz_sqlite_bag(std::string_view input);
void fuzz_yaml_experiment(std::string_view input);
void fuzz_yaml_robot(std::string_view input);
void fuzz_yaml_scenario(std::string_view input);
void fuzz_yaml_set(std::string_view input);

namespace {

namespace fs = std::filesystem;

struct Target {
  const char* name;
  void (*fuzz)(std::string_view input);
};

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
    EXPECT_NO_THROW(GetParam().fuzz(content));
    EXPECT_LT(std::clock() - start, 20 * CLOCKS_PER_SEC);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Corpus,
    ::testing::Values(
        Target{"beliefs", fuzz_beliefs}, Target{"cdr", fuzz_cdr}, Target{"log", fuzz_log},
        Target{"mapping", fuzz_mapping}, Target{"mcap", fuzz_mcap},
        Target{"measurement_model", fuzz_measurement_model}, Target{"mjcf", fuzz_mjcf},
        Target{"neural_network", fuzz_neural_network}, Target{"npy", fuzz_npy},
        Target{"npz", fuzz_npz}, Target{"parameter_model", fuzz_parameter_model},
        Target{"phase_model", fuzz_phase_model}, Target{"sqlite_bag", fuzz_sqlite_bag},
        Target{"yaml_experiment", fuzz_yaml_experiment}, Target{"yaml_robot", fuzz_yaml_robot},
        Target{"yaml_scenario", fuzz_yaml_scenario}, Target{"yaml_set", fuzz_yaml_set}),
    [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace touchdown::fuzz
