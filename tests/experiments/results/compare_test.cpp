#include "experiments/results/compare.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using scoring::Classification;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr std::size_t of_accuracy = 0;
constexpr std::size_t of_balanced_accuracy = 1;

/// A cell with these samples of the scenario "step", as runs 0, 1, 2, …
SampledCell cell_of(const std::string& engine, const std::string& estimator, double torque,
                    const std::vector<Classification>& samples) {
  SampledCell cell{{engine, engine, estimator}, {torque, 0.0}};
  for (const Classification& counts : samples) {
    cell.samples[{"step", static_cast<std::int64_t>(cell.samples.size()), 0}] = counts;
  }
  return cell;
}

SampledRun run_of(const std::string& directory, std::vector<SampledCell> cells) {
  return {directory, std::move(cells), {}};
}

/// Two runs of six steps in contact and four in flight, of which so many are right.
std::vector<Classification> right_steps(std::int64_t contact, std::int64_t flight) {
  return {{6, 0, 0, 4}, {contact, 6 - contact, 4 - flight, flight}};
}

/// Cells with growing changes of the same runs, the last of them the largest.
std::pair<SampledRun, SampledRun> runs_with_changes(std::int64_t cells) {
  std::pair<SampledRun, SampledRun> runs = {run_of("before", {}), run_of("after", {})};
  for (std::int64_t i = 0; i < cells; ++i) {
    const auto torque = static_cast<double>(i);
    runs.first.cells.push_back(
        cell_of("mujoco", "robust", torque, {{100, 0, 0, 0}, {100, 0, 0, 0}}));
    const Classification worse = {99 - i, 1 + i, 0, 0};
    runs.second.cells.push_back(cell_of("mujoco", "robust", torque, {worse, worse}));
  }
  return runs;
}

TEST(Compare, IntervalsAreOfTheDifferencesOfPairs) {
  // Runs of ten steps: of the first, 8 are right before and 9 after; of the second, 6 and 9.
  const std::vector<Classification> before = {{5, 0, 2, 3}, {3, 2, 2, 3}};
  const std::vector<Classification> after = {{5, 0, 1, 4}, {5, 0, 1, 4}};
  const Comparison comparison = compare(run_of("a", {cell_of("mujoco", "robust", 1.0, before)}),
                                        run_of("b", {cell_of("mujoco", "robust", 1.0, after)}));
  ASSERT_EQ(comparison.cells.size(), 1U);
  const ComparedCell& cell = comparison.cells.front();
  EXPECT_EQ(cell.pairs, 2U);
  EXPECT_FALSE(cell.has_equal_counts);
  // A resample holds the first pair twice (+.1), the second twice (+.3) or both (+.2).
  const Movement& movement = cell.metric[of_accuracy];
  EXPECT_DOUBLE_EQ(movement.before, 0.7);
  EXPECT_DOUBLE_EQ(movement.after, 0.9);
  EXPECT_NEAR(movement.difference.estimate, 0.2, 1e-12);
  EXPECT_NEAR(movement.difference.low, 0.1, 1e-12);
  EXPECT_NEAR(movement.difference.high, 0.3, 1e-12);
  EXPECT_TRUE(movement.has_moved());
  // Recalls: (8/10 + 6/10) / 2 before, (10/10 + 8/10) / 2 after.
  EXPECT_DOUBLE_EQ(cell.metric[of_balanced_accuracy].before, 0.7);
  EXPECT_DOUBLE_EQ(cell.metric[of_balanced_accuracy].after, 0.9);
}

TEST(Compare, ChangesOfBothSignsHaveNotMoved) {
  const Comparison comparison =
      compare(run_of("a", {cell_of("mujoco", "robust", 0.0, {{8, 2, 0, 0}, {9, 1, 0, 0}})}),
              run_of("b", {cell_of("mujoco", "robust", 0.0, {{9, 1, 0, 0}, {8, 2, 0, 0}})}));
  EXPECT_FALSE(comparison.cells.front().metric[of_accuracy].has_moved());
  EXPECT_THAT(comparison_text(comparison, of_accuracy), HasSubstr("0 of 1 cell moved; by chance"));
}

TEST(Compare, RunWithItselfHasEqualCounts) {
  const SampledRun run = runs_with_changes(3).second;
  const Comparison comparison = compare(run, run);
  EXPECT_THAT(comparison.left_out, IsEmpty());
  EXPECT_TRUE(std::ranges::all_of(comparison.cells, &ComparedCell::has_equal_counts));
  EXPECT_THAT(comparison_figure(comparison, of_accuracy).series.groups, IsEmpty());
  EXPECT_THAT(comparison_text(comparison, of_accuracy),
              HasSubstr("0 of 3 cells moved: all have equal counts in every run"));
}

TEST(Compare, OnlyTheChangedEstimatorMoves) {
  const std::vector<SampledCell> first = {cell_of("mujoco", "robust", 1.0, right_steps(6, 4)),
                                          cell_of("mujoco", "paper", 1.0, right_steps(6, 4))};
  std::vector<SampledCell> second = first;
  second[1].samples.begin()->second = {4, 2, 1, 3};
  std::next(second[1].samples.begin())->second = {5, 1, 1, 3};
  const std::string text =
      comparison_text(compare(run_of("a", first), run_of("b", second)), of_accuracy);
  EXPECT_THAT(text, AllOf(HasSubstr("paper"), Not(HasSubstr("robust")),
                          HasSubstr("1 of 2 cells moved; 1 with equal counts in every run; by "
                                    "chance alone about 0.1 of the other 1 would")));
}

TEST(Compare, CellsWithOtherTrueContactAreLeftOut) {
  std::vector<SampledCell> first = {cell_of("mujoco", "robust", 1.0, right_steps(5, 4)),
                                    cell_of("bullet", "robust", 0.0, right_steps(5, 4)),
                                    cell_of("bullet", "robust", 1.0, right_steps(5, 4))};
  std::vector<SampledCell> second = first;
  for (const std::size_t i : {1U, 2U}) second[i].samples.rbegin()->second = {6, 1, 0, 3};
  const Comparison comparison = compare(run_of("a", first), run_of("b", second));
  ASSERT_EQ(comparison.cells.size(), 1U);
  EXPECT_EQ(comparison.cells.front().condition.test_simulator, "mujoco");
  EXPECT_THAT(comparison.left_out,
              ElementsAre(HasSubstr("not the same runs: 2 cells of bullet: step run 1 has 6 steps "
                                    "in contact and 4 in flight before, 7 and 3 after")));
  first.erase(first.begin());
  second.erase(second.begin());
  EXPECT_THAT(
      ([&] { (void)compare(run_of("a", first), run_of("b", second)); }),
      ThrowsMessage<InputError>(HasSubstr("a and b: not the same runs: 2 cells of bullet")));
}

TEST(Compare, SamplesAndCellsOfOneRunAreNamed) {
  SampledCell shorter = cell_of("mujoco", "robust", 0.0, right_steps(5, 4));
  shorter.samples.erase(shorter.samples.begin());
  const SampledRun before = run_of("a", {cell_of("mujoco", "robust", 0.0, right_steps(5, 4)),
                                         cell_of("mujoco", "paper", 0.0, right_steps(5, 4)),
                                         cell_of("mujoco", "paper", 1.0, right_steps(5, 4))});
  const SampledRun after =
      run_of("b", {shorter, cell_of("mujoco", "robust", 2.0, right_steps(5, 4))});
  const Comparison comparison = compare(before, after);
  EXPECT_EQ(comparison.cells.front().pairs, 1U);
  EXPECT_TRUE(std::isnan(comparison.cells.front().metric[of_accuracy].difference.low));
  EXPECT_THAT(comparison.left_out,
              ElementsAre("in one of the runs only: 1 sample of 1 cell: step run 0",
                          "only in a: 2 cells: mujoco paper, 0 N·m, 0 m/s² and 1 more",
                          "only in b: 1 cell: mujoco robust, 2 N·m, 0 m/s²"));
}

TEST(Compare, RunsWithoutACommonCellAreRefusedWithTheirEstimators) {
  const auto compared = [] {
    (void)compare(run_of("a", {cell_of("mujoco", "robust", 0.0, right_steps(5, 4))}),
                  run_of("b", {cell_of("mujoco", "paper", 0.0, right_steps(5, 4))}));
  };
  EXPECT_THAT(compared,
              ThrowsMessage<InputError>(AllOf(HasSubstr("estimators of the first: robust"),
                                              HasSubstr("of the second: paper"))));
}

TEST(Compare, TextListsTheLargestTwentyAndTheFigureForty) {
  const auto [before, after] = runs_with_changes(44);
  const Comparison comparison = compare(before, after);
  const std::string text = comparison_text(comparison, of_accuracy);
  EXPECT_LT(text.find("43 N·m"), text.find("42 N·m"));
  EXPECT_THAT(text, AllOf(HasSubstr("24 N·m"), Not(HasSubstr("23 N·m")),
                          HasSubstr("… and 24 more\n\n44 of 44 cells moved; by chance alone about "
                                    "2.2 would\n")));
  const FigureSpec figure = comparison_figure(comparison, of_accuracy);
  EXPECT_EQ(figure.rows.groups.size(), 40U);
  EXPECT_EQ(figure.rows.groups.front().title, "43 N·m, 0 m/s²");
  EXPECT_THAT(figure.caption, HasSubstr("40 of 44 noise settings"));
}

/// A run directory with samples as any build writes them.
class WrittenSamples : public ::testing::Test {
 protected:
  static constexpr const char* header =
      "simulator,fit_simulator,estimator,torque_noise_nm,accelerometer_noise_mps2,knee_noise_nm,"
      "wheel_noise_nm,scenario,run,segment,contact_as_contact,contact_as_flight,flight_as_contact,"
      "flight_as_flight\n";

  void write(const std::string& run, const std::string& rows,
             const std::string& config = "intervals: {level: 0.8}\nunknown_key: 1\n") const {
    folder_.write(run + "/config.yaml", config);
    folder_.write(run + "/tables/samples.csv", header + rows);
  }

  const ScratchFolder folder_{};
};

const std::string of_mujoco =
    "mujoco,mujoco,robust,0.5,1,0.5,0.5,step,0,0,6,1,1,2\n"
    "mujoco,mujoco,robust,0.5,1,0.5,0.5,step,1,0,5,2,0,3\n";
const std::string of_bullet =
    "bullet,mujoco,robust,nan,1,0.5,0,step,1,0,5,2,0,3\n"
    "bullet,mujoco,robust,nan,1,0.5,0,step,0,0,7,0,1,2\n";

TEST_F(WrittenSamples, AreReadWithTheLevelOfTheirExperimentWhateverOtherKeysItHas) {
  write("a", of_mujoco);
  const SampledRun run = read_samples(folder_ / "a");
  EXPECT_EQ(run.bootstrap.level, 0.8);
  ASSERT_EQ(run.cells.size(), 1U);
  EXPECT_EQ(run.cells.front().noise.torque, 0.5);
  EXPECT_EQ(run.cells.front().samples.at({"step", 1, 0}), (Classification{5, 2, 0, 3}));
}

TEST_F(WrittenSamples, ArePairedWhateverTheOrderOfEnginesAndRows) {
  write("a", of_mujoco + of_bullet);
  write("b", of_bullet + of_mujoco);
  const Comparison comparison = compare(read_samples(folder_ / "a"), read_samples(folder_ / "b"));
  EXPECT_EQ(comparison.cells.size(), 2U);
  EXPECT_TRUE(std::ranges::all_of(comparison.cells, &ComparedCell::has_equal_counts));
  EXPECT_EQ(
      to_csv(comparison_table(comparison)),
      to_csv(comparison_table(compare(read_samples(folder_ / "b"), read_samples(folder_ / "b")))));
}

TEST_F(WrittenSamples, ThatAreBrokenAreRefusedWithTheirPlace) {
  write("a", of_mujoco + "mujoco,mujoco,robust,0.5,1,0.5,0.5,step,two,0,6,1,1,2\n");
  EXPECT_THAT(
      [&] { (void)read_samples(folder_ / "a"); },
      ThrowsMessage<InputError>(HasSubstr(
          "a/tables/samples.csv: row 3: run: expected a number of at least 0, found 'two'")));
  folder_.write("a/tables/samples.csv", "simulator,estimator\nmujoco,robust\n");
  EXPECT_THAT([&] { (void)read_samples(folder_ / "a"); },
              ThrowsMessage<InputError>(
                  HasSubstr("a/tables/samples.csv:1: expected a column 'fit_simulator'")));
}

}  // namespace
}  // namespace touchdown::experiments
