#include <csignal>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/table.hpp"
#include "program.hpp"
#include "result_files.hpp"
#include "tests/python_with_numpy.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

namespace fs = std::filesystem;

/// A benchmark of a second: two scenes, two kinds of sensors, two noise settings with two draws of
/// each.
std::string write_benchmark(const ScratchFolder& folder) {
  write_tiny_experiment(folder);
  folder.write("roll.yaml",
               "name: roll\nvelocity: [{time: 0.2, velocity: 0.3}]\nend: {duration: 0.8}\n"
               "perturbation: {velocity: 0.1, yaw: 0.05}\n");
  folder.write("bench.yaml", R"(name: bench
seed: 3
simulators: [mujoco]
estimators: [free_fall]
fit: {scenarios: [step.yaml]}
test: {scenarios: [step.yaml, roll.yaml], runs: 2}
noise: {torque: [0.0, 1.0], accelerometer: [0.0, 5.0], seeds: 2}
highlights: [{torque: 0.0, accelerometer: 0.0}, {torque: 1.0, accelerometer: 5.0}]
intervals: {resamples: 50}
benchmark: {sensors: [noise/profiles/harsh.yaml]}
recordings: none
video: {enabled: false}
)");
  return "bench.yaml";
}

/// The rows of a benchmark's table of one estimator, without its name.
std::vector<std::vector<std::string>> rows_of(const fs::path& run, const std::string& estimator) {
  const TextTable table = from_csv(read_file(run / "tables/benchmark.csv"));
  std::vector<std::vector<std::string>> rows;
  for (std::vector<std::string> row : table.rows) {
    if (row.at(5) != estimator) continue;
    row.erase(row.begin() + 5);
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// Writes constant beliefs for every test file of an export.
void write_constant(const ScratchFolder& folder, const std::string& signals,
                    const std::string& beliefs, const std::string& p) {
  for (const auto& row : from_csv(read_file(folder / signals / "index.csv")).rows) {
    if (row.at(4) != "test") continue;
    folder.write((fs::path(beliefs) / row.at(0)).replace_extension(".csv").string(),
                 fmt::format("time,p_left,p_right\n0,{0},{0}\n", p));
  }
}

/// A finished and exported benchmark.
class Submission : public InFolder {
 protected:
  Submission() {
    folder_.fill("exported", [](const ProgramFolder& folder) {
      folder.output_of("run " + write_benchmark(folder) + " --no-pictures --out run");
      folder.output_of("convert --benchmark signals run");
    });
  }
  std::string ran(const std::string& arguments) const { return folder_.output_of(arguments); }
  /// Scores constant beliefs about the exported signals.
  std::string score_constant(const std::string& name, const std::string& p) const {
    write_constant(folder_, "signals", name, p);
    return ran("score run --beliefs " + name);
  }
};

TEST_F(Submission, ProgramWithTheSameEquationsHasTheSameScores) {
  const std::string python = python_with_numpy();
  if (python.empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  const std::string script = TOUCHDOWN_SOURCE_DIR "/examples/enter/free_fall.py";
  ASSERT_EQ(
      folder_.execute("list", fmt::format("{} {} signals falls &&", python, script)).exit_code, 0);
  ran("report run");
  const std::string output = ran("score run --beliefs falls");
  EXPECT_THAT(output, AllOf(HasSubstr("\n  falls "), HasSubstr("falls: 16 runs scored"),
                            Not(HasSubstr("No beliefs")), Not(HasSubstr("no belief"))));
  const auto ours = rows_of(folder_ / "run", "free_fall");
  ASSERT_EQ(ours.size(), 8U);  // two kinds of sensors, two scenes, two noise settings
  EXPECT_EQ(rows_of(folder_ / "run", "falls"), ours);
  EXPECT_THAT(folder_.text("run/benchmark.html"), HasSubstr("scope=\"row\">falls</th>"));
}

TEST_F(Submission, ProgramInTheDocumentsIsTheTestedOne) {
  const std::string script = read_file(TOUCHDOWN_SOURCE_DIR "/examples/enter/free_fall.py");
  EXPECT_THAT(read_file(TOUCHDOWN_SOURCE_DIR "/docs/guides/enter.md"),
              HasSubstr("```python\n" + script.substr(script.find("import csv")) + "```\n"));
}

TEST_F(Submission, ScoresAreKeptAndReplacedByName) {
  score_constant("first", "1");
  score_constant("second", "0");
  EXPECT_EQ(rows_of(folder_ / "run", "first"), rows_of(folder_ / "run", "always_contact"));
  const auto second = rows_of(folder_ / "run", "second");
  EXPECT_EQ(second.size(), 8U);
  EXPECT_NE(second, rows_of(folder_ / "run", "first"));
  ran("score run --beliefs first --name second");
  EXPECT_EQ(rows_of(folder_ / "run", "second"), rows_of(folder_ / "run", "first"));
  // Running the experiment again, merging it and writing its report keep the scores.
  const std::string table = folder_.text("run/tables/benchmark.csv");
  const std::string results = folder_.text("run/tables/results.csv");
  EXPECT_THAT(results, HasSubstr(",step,second,"));
  EXPECT_THAT(ran("run bench.yaml --out run --no-pictures"), HasSubstr("\n  second "));
  EXPECT_EQ(folder_.text("run/tables/benchmark.csv"), table);
  EXPECT_EQ(folder_.text("run/tables/results.csv"), results);
  ran("run run --no-pictures");
  EXPECT_EQ(folder_.text("run/tables/benchmark.csv"), table);
  ran("report run");
  EXPECT_THAT(folder_.text("run/benchmark.html"), HasSubstr("scope=\"row\">second</th>"));
}

TEST_F(Submission, RunsWithoutBeliefsAreNamedAndNotScored) {
  write_constant(folder_, "signals", "part", "1");
  const std::string stem = "upkie/ideal/mujoco_step_test_001_noise_0_seed_1";
  fs::remove(folder_ / "part" / (stem + ".csv"));  // one draw of a run's noise
  fs::remove_all(folder_ / "part/upkie/harsh");
  const std::string output = ran("score run --beliefs part");
  EXPECT_THAT(output, AllOf(HasSubstr("part: 7 runs scored"),
                            HasSubstr("No beliefs about 17 files, which are not scored: " + stem)));
  const auto rows = rows_of(folder_ / "run", "part");
  ASSERT_EQ(rows.size(), 4U);
  std::map<std::string, int> runs;
  for (const auto& row : rows) ++runs[row.at(3) + " " + row.at(row.size() - 4)];
  EXPECT_EQ(runs, (std::map<std::string, int>{{"roll 2", 2}, {"step 1", 1}, {"step 2", 1}}));
}

TEST_F(Submission, WithoutSomeScenesOrStepsHasNoMeanAndItsStepsCounted) {
  // All steps except the first, in four files of ideal sensors for each of two runs.
  EXPECT_THAT(
      score_constant("rolls", "1"),
      ContainsRegex("[0-9]+ steps in 32 files have no belief: the previous belief is used"));
  for (const auto& file : fs::directory_iterator(folder_ / "rolls/upkie/ideal")) {
    if (file.path().string().find("_step_") != std::string::npos) fs::remove(file);
  }
  EXPECT_THAT(ran("score run --beliefs rolls"), ContainsRegex("\n  rolls +– +1.000 +– +–\n"));
}

TEST_F(Submission, FilesThatAreWrongAreRefusedAndChangeNothing) {
  const auto before = result_files(folder_ / "run");
  const std::string known = "upkie/ideal/mujoco_step_test_000_noise_0_seed_0";
  const auto complaint = [&](const std::string& name, const std::string& text,
                             const std::string& expected) {
    fs::remove_all(folder_ / "wrong");
    write_constant(folder_, "signals", "wrong", "1");
    folder_.write("wrong/" + name, text);
    folder_.expect_refusals({{"score run --beliefs wrong", {"touchdown: wrong/", expected}}});
  };
  complaint(known + ".csv", "time,p_left,p_rihgt\n",
            known + ".csv:1:13: unknown name 'p_rihgt' (did you mean 'p_right'?)");
  complaint(known + ".csv", "time,p_left,p_right\n99,1,1\n",
            known + ".csv:2: time 99 s: expected one of the run, from 0 to 2.5 s");
  complaint("upkie/ideal/mujoco_step_tst_000_noise_0_seed_0.csv", "",
            "the benchmark has no run of this name (did you mean '" + known + "'?)");
  complaint(known + ".mpack", "", known + ".csv is about the same run: expected one of them");
  folder_.expect_refusals(
      {{"score run --beliefs signals", {"README.md: the benchmark has no run of this name"}},
       {"score run --beliefs nowhere", {"nowhere: no such file or folder"}},
       {"score run --beliefs wrong --name free_fall",
        {"'free_fall' is one of touchdown's own estimators"}},
       {"score run --beliefs wrong --name ../x", {"--name: "}},
       {"score run --beliefs wrong --name 'mine_\xe9'", {"--name: "}},
       {"score run --beliefs wrong --name 'mine_\xe2\x80\xae'", {"--name: "}}});
  EXPECT_THAT(different_files(result_files(folder_ / "run"), before), IsEmpty());
}

TEST_F(Submission, FilesOfOneRunCanBeScoredAlone) {
  folder_.write("bullet.yaml",
                "name: once\nsimulators: [bullet]\nestimators: [free_fall]\n"
                "fit: {scenarios: [roll.yaml]}\ntest: {scenarios: [roll.yaml], runs: 1}\n"
                "highlights: [{torque: 0, accelerometer: 0}]\nbenchmark: {}\n"
                "video: {enabled: false}\nrecordings: all\n");
  ran("run bullet.yaml --no-pictures --out once");
  const std::string name = "bullet_roll_test_000_noise_0_seed_0";
  folder_.write(name + ".csv", "time,p_left,p_right\n0,1,1\n");
  ran("score once --name mine --beliefs " + name + ".csv");
  EXPECT_EQ(rows_of(folder_ / "once", "mine"), rows_of(folder_ / "once", "always_contact"));
  folder_.write("bullet_rol_test_000_noise_0_seed_0.csv", "");
  folder_.write("mujoco_roll_test_002_noise_0_seed_0.csv", "time,p_left,p_right\n0,1,1\n");
  folder_.expect_refusals({{"score once --beliefs bullet_rol_test_000_noise_0_seed_0.csv",
                            {"did you mean '" + name + "'?"}},
                           {"score run --beliefs mujoco_roll_test_002_noise_0_seed_0.csv",
                            {"the benchmark has 2 runs of this name"}}});
}

TEST_F(Submission, RunsThatFellAreNotExportedAndCountAsFailed) {
  const std::string step = folder_.text("step.yaml");
  folder_.write("deep.yaml", std::regex_replace(step, std::regex("rise: 0.25"), "rise: 0.7"));
  folder_.write("falls.yaml",
                "name: falls\nseed: 3\nsimulators: [mujoco]\nestimators: [free_fall]\n"
                "fit: {scenarios: [step.yaml]}\ntest: {scenarios: [deep.yaml], runs: 6}\n"
                "highlights: [{torque: 0, accelerometer: 0}]\nbenchmark: {}\nrecordings: none\n"
                "video: {enabled: false}\n");
  ran("run falls.yaml --no-pictures --out fell");
  const auto ours = rows_of(folder_ / "fell", "always_contact");
  ASSERT_EQ(ours.size(), 1U);
  const std::size_t failed = std::stoul(ours[0].at(ours[0].size() - 3));
  ASSERT_GT(failed, 0U) << "no robot falls down this step any more";
  ran("convert --benchmark upright fell");
  EXPECT_EQ(from_csv(folder_.text("upright/index.csv")).rows.size(), 7U - failed);
  write_constant(folder_, "upright", "stays", "1");
  EXPECT_THAT(ran("score fell --beliefs stays"), Not(HasSubstr("not scored: upkie")));
  EXPECT_EQ(rows_of(folder_ / "fell", "stays"), ours);
}

TEST_F(Submission, UnfinishedBenchmarksAndOtherRunsAreRefused) {
  ran("run tiny.yaml --no-pictures --out tiny");
  ran("run bench.yaml --no-pictures --shard 1/2 --out half");
  folder_.expect_refusals(
      {{"score nowhere --beliefs signals", {"nowhere: holds no part of an experiment"}},
       {"score tiny --beliefs signals",
        {"experiment 'tiny' is no benchmark: expected a section 'benchmark'"}},
       {"convert --benchmark x tiny.yaml", {"is no benchmark"}},
       {"score half --beliefs signals",
        {"half: is not finished: run the same experiment again first"}}});
}

TEST_F(Submission, ExportsAreTheSameBytesFromARunAndFromItsExperimentOnAnyThreads) {
  ran("convert --benchmark again bench.yaml");
  EXPECT_THAT(different_files(folder_ / "signals", folder_ / "again"), IsEmpty());
  std::string text = folder_.text("bench.yaml");
  folder_.write("one_thread.yaml", text + "workers: 1\n");
  ran("convert --benchmark one_thread one_thread.yaml");
  EXPECT_THAT(different_files(folder_ / "signals", folder_ / "one_thread"), IsEmpty());
  const std::string checked = "(cd signals && sha256sum --check --strict --quiet SHA256SUMS) &&";
  EXPECT_EQ(folder_.execute("list", checked).exit_code, 0);
  const TextTable index = from_csv(folder_.text("signals/index.csv"));
  EXPECT_THAT(index.header, ElementsAre("file", "robot", "sensors", "simulator", "role", "scene",
                                        "run", "noise", "seed", "torque_noise_nm",
                                        "accelerometer_noise_mps2", "steps", "control_period_s"));
  // For each kind of sensors a fitted run and four tested ones, with two noises and draws of each.
  ASSERT_EQ(index.rows.size(), 2U * (1 + 4 * 4));
  for (const auto& row : index.rows) EXPECT_TRUE(fs::exists(folder_ / "signals" / row.at(0)));
  EXPECT_EQ(names_in(folder_ / "signals"),
            (std::set<std::string>{"README.md", "SHA256SUMS", "index.csv", "upkie"}));
}

TEST_F(Submission, ExportsAreTheSameBytesFromRecordingsAndWhereTheseAreGone) {
  const std::string text = folder_.text("bench.yaml");
  folder_.write("kept.yaml",
                std::regex_replace(text, std::regex("recordings: none"), "recordings: all"));
  ran("run kept.yaml --no-pictures --out kept");
  ran("convert --benchmark recorded kept");
  fs::remove_all(folder_ / "kept/recordings");
  ran("convert --benchmark simulated kept");
  const auto recorded = result_files(folder_ / "recorded");
  EXPECT_THAT(different_files(recorded, result_files(folder_ / "simulated")), IsEmpty());
  EXPECT_FALSE(folder_.has("kept/recordings"));
  // The README names the request's digest, which differs. The signals are the same.
  EXPECT_THAT(different_files(recorded, result_files(folder_ / "signals")),
              ElementsAre("README.md", "SHA256SUMS"));
}

TEST_F(Submission, PartsOfAnExportAreChosenByName) {
  ran("convert --benchmark harsh run --sensors harsh --robot upkie --simulator mujoco");
  EXPECT_EQ(names_in(folder_ / "harsh/upkie"), std::set<std::string>{"harsh"});
  const std::string outline = ran("convert --benchmark no run --sensors harsh --dry-run");
  EXPECT_THAT(outline, ContainsRegex("\n  upkie +harsh +mujoco +1 +16 +"));
  EXPECT_THAT(outline, Not(HasSubstr("ideal")));
  EXPECT_FALSE(folder_.has("no"));
  folder_.expect_refusals(
      {{"convert --benchmark no run --sensors harhs",
        {"--sensors: the benchmark has no 'harhs': expected one of ideal, harsh (did you mean "
         "'harsh'?)"}},
       {"convert --benchmark signals run", {"signals: holds '"}},
       {"convert --benchmark bench.yaml run", {"bench.yaml: is no folder"}},
       {"convert --benchmark no nowhere.yaml", {"nowhere.yaml"}}});
}

using Export = InFolder;

TEST_F(Export, ThatIsInterruptedLeavesNothing) {
  write_long_experiment(folder_);
  folder_.write("x.yaml", folder_.text("x.yaml") + "benchmark: {}\n");
  fs::create_directory(folder_ / "empty");
  for (const std::string out : {"new", "empty"}) {
    StartedProgram program("convert --benchmark " + out + " x.yaml", folder_.path());
    program.let_run_until([&] { return folder_.has(out) && !fs::is_empty(folder_ / out); });
    program.let_run(0.05);
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.errors, HasSubstr("touchdown: stopped; nothing was written\n"));
  }
  EXPECT_FALSE(folder_.has("new"));
  EXPECT_TRUE(fs::is_empty(folder_ / "empty"));
}

TEST_F(Export, ThatExceedsTheDiskIsRefusedBeforeItBegins) {
  write_benchmark(folder_);
  folder_.write("roll.yaml", "name: roll\nend: {duration: 100000}\nperturbation: {yaw: 0.05}\n");
  folder_.write("bench.yaml", std::regex_replace(folder_.text("bench.yaml"), std::regex("runs: 2"),
                                                 "runs: 1000"));
  folder_.expect_refusals(
      {{"convert --benchmark signals bench.yaml", {"this export may need", "choose a part"}}}, 1);
  EXPECT_FALSE(folder_.has("signals"));
}

}  // namespace
}  // namespace touchdown::cli
