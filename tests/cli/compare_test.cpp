#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/table.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A finished run, "before".
class Compared : public InFolder {
 protected:
  Compared() {
    folder_.fill("before", [](const ProgramFolder& folder) { run_into(folder, "before"); });
  }

  static void run_into(const ProgramFolder& folder, const std::string& directory,
                       const std::string& options = "") {
    (void)folder.output_of("run " + write_tiny_experiment(folder) +
                           " --set simulators=[mujoco] --set noise.seeds=1 --no-pictures --out " +
                           directory + " " + options);
  }
  void run_into(const std::string& directory, const std::string& options = "") const {
    run_into(folder_, directory, options);
  }
};

TEST_F(Compared, SameRunTwiceHasEqualCountsInAllCells) {
  run_into("after");
  // 3 estimators and always contact, 4 noise settings
  EXPECT_THAT(folder_.output_of("compare before after"),
              HasSubstr("0 of 16 cells moved: all have equal counts in every run\n"));
  EXPECT_EQ(folder_.text("before/tables/samples.csv"), folder_.text("after/tables/samples.csv"));
  // … each with 3 test runs
  EXPECT_EQ(from_csv(folder_.text("before/tables/samples.csv")).rows.size(), 16U * 3U);
}

TEST_F(Compared, RunsWithAnEditedTableAreNamed) {
  run_into("after");
  const std::string edited = "/tables/samples.csv: was edited since the run wrote it";
  EXPECT_THAT(folder_.messages_of("compare before after"), Not(HasSubstr(edited)));
  const std::string samples = folder_.text("after/tables/samples.csv");
  folder_.write("after/tables/samples.csv",
                samples.substr(0, samples.rfind('\n', samples.size() - 2) + 1));
  EXPECT_THAT(folder_.messages_of("compare before after"),
              AllOf(HasSubstr("after" + edited), Not(HasSubstr("before" + edited))));
  EXPECT_THAT(folder_.messages_of("compare after before"), HasSubstr("after" + edited));
}

TEST_F(Compared, SamplesOfDropsAddUpToTheAccuracyOfTheirCells) {
  run_into("drops", "--set intervals.over=drop --set test.scenarios=[scenarios/hop.yaml]");
  const Table samples = table_of(from_csv(folder_.text("drops/tables/samples.csv")));
  const Table cells = table_of(from_csv(folder_.text("drops/tables/success.csv")));
  const std::vector<std::string> keys = {"simulator", "estimator", "torque_noise_nm",
                                         "accelerometer_noise_mps2"};
  for (const TableRow& cell : cells.all()) {
    double right = 0.0;
    double all = 0.0;
    std::set<std::string> drops;
    for (const TableRow& sample : samples.all()) {
      const bool is_of_cell = std::ranges::all_of(
          keys, [&](const std::string& key) { return sample.text(key) == cell.text(key); });
      if (!is_of_cell) continue;
      drops.insert(sample.text("run") + " " + sample.text("segment"));
      const double agreed = sample.number("contact_as_contact") + sample.number("flight_as_flight");
      right += agreed;
      all += agreed + sample.number("contact_as_flight") + sample.number("flight_as_contact");
    }
    EXPECT_EQ(drops, (std::set<std::string>{"0 0", "0 1", "1 0", "1 1", "2 0", "2 1"}));
    EXPECT_NEAR(cell.number("success"), right / all, 1e-6);
  }
  EXPECT_EQ(cells.rows.size(), 16U);
}

TEST_F(Compared, ChangedEstimatorAloneMoves) {
  run_into("after", "--set hyperparameters.measurement_only.threshold=0.2");
  const std::string text =
      folder_.output_of("compare before after -o moved.csv --figure moved.svg");
  EXPECT_THAT(text, AllOf(HasSubstr("measurement_only"), Not(HasSubstr("upkie_observer")),
                          Not(HasSubstr("robust")), HasSubstr("table     moved.csv")));
  for (const char* const file : {"moved.png", "moved.svg", "moved.pdf"}) {
    EXPECT_TRUE(folder_.has(file)) << file;
  }
  const Table table = table_of(from_csv(folder_.text("moved.csv")));
  EXPECT_EQ(table.rows.size(), 16U);
  for (const TableRow& row : table.all()) {
    if (row.text("estimator") == "measurement_only") continue;
    EXPECT_EQ(row.interval("accuracy_difference").estimate, 0.0) << row.text("estimator");
    EXPECT_EQ(row.text("balanced_accuracy_moved"), "0");
  }
  EXPECT_EQ(folder_.output_of("compare before after -o again.csv --figure moved.svg"),
            std::string(text).replace(text.find("moved.csv"), 9, "again.csv"));
  EXPECT_EQ(folder_.text("again.csv"), folder_.text("moved.csv"));
  EXPECT_THAT(folder_.output_of("compare before after --metric balanced_accuracy"),
              HasSubstr("balanced accuracy: after minus before, 95 % intervals"));
}

TEST_F(Compared, WhatCannotBeComparedIsRefusedInOneLine) {
  run_into("seed", "--set seed=4");
  run_into("others",
           "--set estimators=[free_fall] --set noise.torque=[2.0] --set 'highlights=[{torque: 2.0, "
           "accelerometer: 5.0}]'");
  std::filesystem::copy(folder_ / "before", folder_ / "older",
                        std::filesystem::copy_options::recursive);
  std::filesystem::remove(folder_ / "older/tables/samples.csv");
  folder_.expect_refusals({
      {"compare before seed",
       {"before and seed: not the same runs: 16 cells of mujoco: step run "}},
      {"compare before others",
       {"no cell of engine, estimator and noise in common", "robust, measurement_only",
        "of the second: free_fall"}},
      {"compare before older", {"older: ", "no tables/samples.csv; `touchdown run` it again"}},
      {"compare before tiny.yaml", {"tiny.yaml: no run directory of an experiment"}},
      {"compare before before --metric f1", {"f1"}},
      {"compare before before -o before/tables/samples.csv", {"samples.csv"}},
      {"compare before before --figure x.jpg", {"--figure: 'x.jpg'"}},
  });
}

}  // namespace
}  // namespace touchdown::cli
