#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "program.hpp"
#include "tests/cli/result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

/// The results that must not depend on time, place and number of threads.
std::map<std::string, std::string> reproducible_files(const fs::path& run_directory) {
  std::map<std::string, std::string> files;
  for (const char* folder : {"tables", "recordings", "models"}) {
    if (!fs::exists(run_directory / folder)) continue;  // no recordings are kept
    for (const auto& entry : fs::directory_iterator(run_directory / folder)) {
      files[folder + std::string("/") + entry.path().filename().string()] = read_file(entry.path());
    }
  }
  files["config.yaml"] = read_file(run_directory / "config.yaml");
  return files;
}

void run_tiny(const ScratchFolder& folder, const std::string& flags) {
  const Ended ended = touchdown_program("run tiny.yaml " + flags, folder.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
}

TEST(Run, GivesTheSameBytesInTwoProcessesAndWithOneAndFourThreads) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  run_tiny(folder, "--out a --set workers=4");
  run_tiny(folder, "--out b --set workers=4");
  run_tiny(folder, "--out c --set workers=1");
  const auto first = reproducible_files(folder.path() / "a");
  EXPECT_EQ(first.count("tables/success.csv"), 1U);
  EXPECT_EQ(first.count("recordings/bullet_step_test_002.mpack"), 1U);
  for (const char* other : {"b", "c"}) {
    const auto files = reproducible_files(folder.path() / other);
    ASSERT_EQ(files.size(), first.size());
    for (const auto& [name, content] : first) {
      EXPECT_TRUE(files.at(name) == content) << name << " differs in " << other;
    }
  }
}

/// The cells of a CSV file without quotes, by row.
std::vector<std::vector<std::string>> cells_of(const fs::path& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read_file(csv));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST(Run, DrawsFiguresThatAgreeWithItsTables) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  run_tiny(folder, "--out a");
  const std::string report = read_file(folder / "a/report.html");
  for (const char* figure : {"error", "densities", "reliability", "latency"}) {
    for (const char* engine : {"mujoco", "bullet"}) {
      const std::string name = std::string("a/figures/") + figure + "_" + engine;
      for (const char* kind : {".png", ".svg", ".pdf", ".gp", ".dat"}) {
        EXPECT_TRUE(fs::exists(folder / (name + kind))) << name << kind;
      }
      EXPECT_THAT(report, HasSubstr(name.substr(2) + ".dat"));
    }
    EXPECT_THAT(read_file(folder / (std::string("a/figures/") + figure + "_mujoco.gp")),
                HasSubstr("contact: normal force > 1 N, states under 5 ms merged"));
  }
  EXPECT_THAT(read_file(folder / "a/figures/latency_mujoco.gp"),
              HasSubstr("# Caption: 3 test runs × 2 noise seeds"));
  // For both wheels pooled, the figure's detected events are those of the table.
  const std::string latency = read_file(folder / "a/figures/latency_mujoco.dat");
  const std::string reliability = read_file(folder / "a/figures/reliability_mujoco.dat");
  const auto column = [](const std::vector<std::string>& header, const std::string& name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const auto found = cells_of(folder / "a/tables/latency.csv");
  const auto events = cells_of(folder / "a/tables/transitions.csv");
  int rows = 0;
  for (std::size_t r = 1; r < found.size(); ++r) {
    if (found[r][0] != "mujoco" || found[r][4] != "wheels" || found[r][1] == "always_contact") {
      continue;
    }
    for (const std::string kind : {"takeoff", "landing"}) {
      EXPECT_THAT(latency, HasSubstr(found[r].at(column(found[0], kind + "s_detected")) + " of " +
                                     events[r].at(column(events[0], kind + "s")) + " found"));
    }
    ++rows;
  }
  EXPECT_EQ(rows, 3);
  for (const auto& row : cells_of(folder / "a/tables/reliability.csv")) {
    if (row[0] != "mujoco" || row[4] != "wheels" || row[1] != "robust" || row[6] == "0") continue;
    EXPECT_THAT(reliability, HasSubstr("\t" + row[6] + "\n"));
  }
}

TEST(Run, GivesOtherNumbersForAnotherSeed) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  run_tiny(folder, "--out a");
  run_tiny(folder, "--out b --set seed=4");
  EXPECT_NE(read_file(folder.path() / "a/tables/success.csv"),
            read_file(folder.path() / "b/tables/success.csv"));
}

TEST(Run, LeavesADirectoryThatExplainsItself) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  run_tiny(folder, "");
  const fs::path latest = folder.path() / "runs/tiny/latest";
  ASSERT_TRUE(fs::is_symlink(latest));
  EXPECT_THAT(read_file(latest / "tables/success.csv"),
              StartsWith("simulator,estimator,torque_noise_nm,accelerometer_noise_mps2,success,"
                         "success_low,success_high"));
  EXPECT_THAT(read_file(latest / "tables/classification.csv"), HasSubstr("contact_precision,"));
  EXPECT_THAT(read_file(latest / "tables/success.csv"), HasSubstr("bullet,always_contact,1,5,"));
  for (const char* key :
       {"\"versions\"", "\"commit\": \"", "\"seeds\"", "\"host\"", "\"timings_s\""}) {
    EXPECT_THAT(read_file(latest / "manifest.json"), HasSubstr(key));
  }
}

TEST(Run, EndsWithResultsPathsAndNextCommands) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  const Ended ended = touchdown_program("run tiny.yaml --out a", folder.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  const std::string last = ended.output.substr(ended.output.find("Contact accuracy"));
  EXPECT_THAT(last, StartsWith("Contact accuracy, torque noise 1 N·m, "
                               "accelerometer noise 5 m/s²\n"));
  for (const auto& row : cells_of(folder / "a/tables/success.csv")) {
    if (row[1] != "robust" || row[2] != "1" || row[3] != "5") continue;
    EXPECT_THAT(last, HasSubstr(fmt::format("{:.3f} [{:.3f}, {:.3f}]", std::stod(row[4]),
                                            std::stod(row[5]), std::stod(row[6]))));
  }
  for (const char* line :
       {"\nreport    a/report.html\n", "\nfigures   a/figures\n", "\nnext      "}) {
    EXPECT_THAT(last, HasSubstr(line));
  }
}

TEST(Run, OfItsOwnResolvedConfigurationGivesTheSameResults) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  run_tiny(folder, "--out a");
  const Ended ended = touchdown_program("run a/config.yaml --out b", folder.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_EQ(reproducible_files(folder.path() / "a"), reproducible_files(folder.path() / "b"));
}

TEST(Run, UsesExistingRecordings) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  run_tiny(folder, "--out a");
  const fs::path recording = folder.path() / "a/recordings/mujoco_step_test_000.mpack";
  const auto written = fs::last_write_time(recording);
  const auto before = reproducible_files(folder.path() / "a");
  fs::remove(folder.path() / "a/recordings/mujoco_step_test_001.mpack");
  run_tiny(folder, "--out a");
  EXPECT_EQ(fs::last_write_time(recording), written);
  EXPECT_EQ(reproducible_files(folder.path() / "a"), before);
}

TEST(Run, KeepsTheRequestedRecordingsAndTheSameTables) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  run_tiny(folder, "--no-pictures --out all");
  run_tiny(folder, "--no-pictures --out pictured --set recordings=pictured --set video.run=1");
  run_tiny(folder, "--no-pictures --out none --set recordings=none");
  EXPECT_EQ(names_in(folder.path() / "all/recordings").size(), 8U);
  EXPECT_THAT(names_in(folder.path() / "pictured/recordings"),
              ElementsAre("bullet_step_test_001.mpack", "mujoco_step_test_001.mpack"));
  EXPECT_FALSE(fs::exists(folder.path() / "none/recordings"));
  EXPECT_EQ(read_file(folder.path() / "pictured/recordings/bullet_step_test_001.mpack"),
            read_file(folder.path() / "all/recordings/bullet_step_test_001.mpack"));
  auto all = reproducible_files(folder.path() / "all");
  for (const char* other : {"pictured", "none"}) {
    for (const auto& [name, content] : reproducible_files(folder.path() / other)) {
      if (name == "config.yaml") continue;
      EXPECT_EQ(content, all[name]) << name << " of " << other;
    }
  }
}

TEST(Run, WithoutRecordingsContinuesAndMergesToTheSameBytes) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  const std::string none = "--no-pictures --set recordings=none --out ";
  run_tiny(folder, none + "whole");
  const auto whole = reproducible_files(folder.path() / "whole");
  run_tiny(folder, none + "whole");
  EXPECT_EQ(reproducible_files(folder.path() / "whole"), whole);
  run_tiny(folder, none + "parts --shard 2/2");
  run_tiny(folder, none + "parts --shard 1/2");
  const Ended merged = touchdown_program("merge parts --no-pictures", folder.path());
  ASSERT_EQ(merged.exit_code, 0) << merged.errors;
  EXPECT_EQ(reproducible_files(folder.path() / "parts"), whole);
}

TEST(Run, ThatIsFilmedNeedsRecordings) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  const Ended ended = touchdown_program(
      "run tiny.yaml --set recordings=none --set video.enabled=true", folder.path());
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.errors, AllOf(HasSubstr("recordings: expected all or pictured"),
                                  HasSubstr("none goes with video.enabled: false")));
}

TEST(Simulate, RecordsTheSameRunTwice) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  for (const std::string name : {"a", "b"}) {
    const Ended ended = touchdown_program(
        "simulate step.yaml --simulator bullet --run 1 --seed 9 -o " + name + ".mpack",
        folder.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    EXPECT_THAT(ended.output, HasSubstr("step"));
  }
  EXPECT_EQ(read_file(folder.path() / "a.mpack"), read_file(folder.path() / "b.mpack"));
  touchdown_program("simulate step.yaml --simulator bullet --run 2 --seed 9 -o c.mpack",
                    folder.path());
  EXPECT_NE(read_file(folder.path() / "a.mpack"), read_file(folder.path() / "c.mpack"));
}

}  // namespace
}  // namespace touchdown::cli
