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

/// A folder with the tiny experiment.
struct Run : InFolder {
  Run() { write_tiny_experiment(folder_); }
  std::string run_tiny(const std::string& flags) const {
    return folder_.output_of("run tiny.yaml " + flags);
  }
  std::map<std::string, std::string> files_of(const std::string& directory) const {
    return reproducible_files(folder_ / directory);
  }
};
using Simulate = Run;

TEST_F(Run, GivesTheSameBytesAgainWithAnyThreadsAndFromItsResolvedConfiguration) {
  run_tiny("--no-pictures --out a --set workers=4");
  run_tiny("--no-pictures --out b --set workers=4");
  run_tiny("--no-pictures --out c --set workers=1");
  folder_.output_of("run a/config.yaml --no-pictures --out d");
  const auto first = files_of("a");
  EXPECT_EQ(first.count("tables/success.csv"), 1U);
  EXPECT_EQ(first.count("recordings/bullet_step_test_002.mpack"), 1U);
  for (const char* other : {"b", "c", "d"}) {
    const auto files = files_of(other);
    ASSERT_EQ(files.size(), first.size());
    for (const auto& [name, content] : first) {
      EXPECT_TRUE(files.at(name) == content) << name << " differs in " << other;
    }
  }
  run_tiny("--no-pictures --out e --set seed=4");
  EXPECT_NE(first.at("tables/success.csv"), folder_.text("e/tables/success.csv"));
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

TEST_F(Run, DrawsFiguresThatAgreeWithItsTables) {
  write_finished_run(folder_, "");
  const std::string report = folder_.text("a/report.html");
  for (const char* figure : {"error", "densities", "reliability", "latency"}) {
    for (const char* engine : {"mujoco", "bullet"}) {
      const std::string name = std::string("a/figures/") + figure + "_" + engine;
      for (const char* kind : {".png", ".svg", ".pdf", ".gp", ".dat"}) {
        EXPECT_TRUE(folder_.has(name + kind)) << name << kind;
      }
      EXPECT_THAT(report, HasSubstr(name.substr(2) + ".dat"));
    }
    EXPECT_THAT(folder_.text(std::string("a/figures/") + figure + "_mujoco.gp"),
                HasSubstr("contact: normal force > 1.9 % of the weight, mean over 10 ms"));
  }
  EXPECT_THAT(folder_.text("a/figures/latency_mujoco.gp"),
              HasSubstr("# Caption: 3 test runs × 2 noise seeds"));
  // For both wheels pooled, the figure's curves end at the share of detected events.
  const auto latency = cells_of(folder_ / "a/figures/latency_mujoco.dat");
  const std::string reliability = folder_.text("a/figures/reliability_mujoco.dat");
  const auto column = [](const std::vector<std::string>& header, const std::string& name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const auto found = cells_of(folder_ / "a/tables/latency.csv");
  const auto events = cells_of(folder_ / "a/tables/transitions.csv");
  int rows = 0;
  for (std::size_t r = 1; r < found.size(); ++r) {
    if (found[r][0] != "mujoco" || found[r][4] != "wheels" || found[r][1] == "always_contact") {
      continue;
    }
    const auto last = std::find_if(latency.rbegin(), latency.rend(), [&](const auto& row) {
      return std::equal(row.begin(), row.begin() + 5, found[r].begin());
    });
    ASSERT_NE(last, latency.rend());
    for (const std::string kind : {"takeoff", "landing"}) {
      const auto number = [&](const auto& header, const auto& row, const std::string& name) {
        return std::stod(row.at(column(header, kind + name)));
      };
      EXPECT_NEAR(number(latency[0], *last, "s_found") * number(events[0], events[r], "s"),
                  number(found[0], found[r], "s_detected"), 1e-3);
    }
    ++rows;
  }
  EXPECT_EQ(rows, 3);
  for (const auto& row : cells_of(folder_ / "a/tables/reliability.csv")) {
    if (row[0] != "mujoco" || row[4] != "wheels" || row[1] != "robust" || row[6] == "0") continue;
    EXPECT_THAT(reliability, HasSubstr(fmt::format("wheels,{},", row[5])));
    EXPECT_THAT(reliability, HasSubstr(fmt::format(",{},{}\n", row[6], row[7])));
  }
}

TEST_F(Run, ExplainsItselfAndEndsWithResultsPathsAndNextCommands) {
  write_finished_run(folder_, "");
  const std::string output = folder_.text(".stdout");
  EXPECT_THAT(folder_.text("a/tables/success.csv"),
              AllOf(StartsWith("simulator,estimator,torque_noise_nm,accelerometer_noise_mps2,"
                               "success,success_low,success_high"),
                    HasSubstr("bullet,always_contact,1,5,")));
  EXPECT_THAT(folder_.text("a/tables/classification.csv"), HasSubstr("contact_precision,"));
  for (const char* key :
       {"\"versions\"", "\"commit\": \"", "\"seeds\"", "\"host\"", "\"timings_s\""}) {
    EXPECT_THAT(folder_.text("a/manifest.json"), HasSubstr(key));
  }
  const std::string last = output.substr(output.find("F1 of takeoffs and landings within"));
  EXPECT_THAT(last, StartsWith("F1 of takeoffs and landings within 20 ms, torque noise 1 N·m, "
                               "accelerometer noise 5 m/s²\n"));
  for (const auto& row : cells_of(folder_ / "a/tables/ranking.csv")) {
    if (row[1] != "robust" || row[2] != "1" || row[3] != "5" || row[4] != "wheels") continue;
    EXPECT_THAT(last, HasSubstr(fmt::format("{:.3f} [{:.3f}, {:.3f}]", std::stod(row[5]),
                                            std::stod(row[6]), std::stod(row[7]))));
  }
  for (const char* line :
       {"\nreport    a/report.html\n", "\nfigures   a/figures\n", "\nnext      "}) {
    EXPECT_THAT(last, HasSubstr(line));
  }
}

TEST_F(Run, UsesExistingRecordings) {
  write_finished_run(folder_);
  const fs::path recording = folder_ / "a/recordings/mujoco_step_test_000.mpack";
  const auto written = fs::last_write_time(recording);
  const auto before = files_of("a");
  fs::remove(folder_ / "a/recordings/mujoco_step_test_001.mpack");
  run_tiny("--no-pictures --out a");
  EXPECT_EQ(fs::last_write_time(recording), written);
  EXPECT_EQ(files_of("a"), before);
}

TEST_F(Run, KeepsTheRequestedRecordingsAndTheSameTables) {
  write_finished_run(folder_);
  run_tiny("--no-pictures --out pictured --set recordings=pictured --set video.run=1");
  run_tiny("--no-pictures --out none --set recordings=none");
  EXPECT_EQ(names_in(folder_ / "a/recordings").size(), 8U);
  EXPECT_THAT(names_in(folder_ / "pictured/recordings"),
              ElementsAre("bullet_step_test_001.mpack", "mujoco_step_test_001.mpack"));
  EXPECT_FALSE(folder_.has("none/recordings"));
  EXPECT_EQ(folder_.text("pictured/recordings/bullet_step_test_001.mpack"),
            folder_.text("a/recordings/bullet_step_test_001.mpack"));
  auto all = files_of("a");
  for (const char* other : {"pictured", "none"}) {
    for (const auto& [name, content] : files_of(other)) {
      if (name == "config.yaml") continue;
      EXPECT_EQ(content, all[name]) << name << " of " << other;
    }
  }
}

TEST_F(Run, WithoutRecordingsContinuesAndMergesToTheSameBytes) {
  const std::string none = "--no-pictures --set recordings=none --out ";
  run_tiny(none + "whole");
  const auto whole = files_of("whole");
  run_tiny(none + "whole");
  EXPECT_EQ(files_of("whole"), whole);
  run_tiny(none + "parts --shard 2/2");
  run_tiny(none + "parts --shard 1/2");
  folder_.output_of("run parts --no-pictures");
  EXPECT_EQ(files_of("parts"), whole);
}

TEST_F(Run, ThatIsFilmedNeedsRecordings) {
  folder_.expect_refusals(
      {{"run tiny.yaml --set recordings=none --set video.enabled=true",
        {"recordings: expected all or pictured", "none goes with video.enabled: false"}}});
}

TEST_F(Simulate, CountsTheFlightsOfEachWheelThatEstimateScores) {
  for (const std::string scenario : {"kerb", "hop", "flat", "push_off"}) {
    const std::string line =
        folder_.output_of("simulate scenarios/" + scenario + ".yaml -o run.mpack");
    const auto number_after = [](const std::string& text, const std::string& before) {
      return std::stoi(text.substr(text.find(before) + before.size()));
    };
    const std::string estimated = folder_.output_of("estimate run.mpack");
    EXPECT_THAT(line, HasSubstr(" of a wheel\n"));
    EXPECT_EQ(number_after(line, " s, "),
              number_after(estimated.substr(estimated.rfind("takeoffs ")), " of "))
        << scenario << '\n'
        << line << estimated;
  }
}

TEST_F(Simulate, RecordsTheSameRunTwice) {
  const std::string simulate = "simulate step.yaml --simulator bullet --seed 9 --run ";
  EXPECT_THAT(folder_.output_of(simulate + "1 -o a.mpack"), HasSubstr("step"));
  folder_.output_of(simulate + "1 -o b.mpack");
  folder_.output_of(simulate + "2 -o c.mpack");
  EXPECT_EQ(folder_.text("a.mpack"), folder_.text("b.mpack"));
  EXPECT_NE(folder_.text("a.mpack"), folder_.text("c.mpack"));
}

}  // namespace
}  // namespace touchdown::cli
