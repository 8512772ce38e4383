#include <csignal>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "program.hpp"
#include "result_files.hpp"
#include "started_program.hpp"
#include "tests/python_with_numpy.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
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
               "name: roll\nvelocity: [{time: 0.2, velocity: 0.3}]\nend: {duration: 0.8}\n");
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

std::string ran(const std::string& arguments, const ScratchFolder& folder) {
  const Ended ended = touchdown_program(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << arguments << "\n" << ended.errors;
  return ended.output;
}

std::string refused(const std::string& arguments, const ScratchFolder& folder) {
  const Ended ended = touchdown_program(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, 2) << arguments << "\n" << ended.errors;
  return ended.errors;
}

bool shell(const std::string& command, const ScratchFolder& folder) {
  return std::system(fmt::format("cd '{}' && {}", folder.path().string(), command).c_str()) == 0;
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
class Submission : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new ScratchFolder;
    ran("run " + write_benchmark(*folder) + " --no-pictures --out run", *folder);
    ran("export --benchmark signals run", *folder);
  }
  static void TearDownTestSuite() { delete folder; }

  static ScratchFolder* folder;
};
ScratchFolder* Submission::folder = nullptr;

TEST_F(Submission, ProgramWithTheSameEquationsHasTheSameScores) {
  const std::string python = python_with_numpy();
  if (python.empty()) GTEST_SKIP() << "python3 with NumPy is not installed";
  const std::string script = TOUCHDOWN_SOURCE_DIR "/examples/enter/free_fall.py";
  ASSERT_TRUE(shell(fmt::format("{} {} signals falls", python, script), *folder));
  ran("report run", *folder);
  const std::string output = ran("score run --beliefs falls", *folder);
  EXPECT_THAT(output, AllOf(HasSubstr("\n  falls "), HasSubstr("falls: 16 runs scored"),
                            Not(HasSubstr("No beliefs")), Not(HasSubstr("no belief"))));
  const auto ours = rows_of(*folder / "run", "free_fall");
  ASSERT_EQ(ours.size(), 8U);  // two kinds of sensors, two scenes, two noise settings
  EXPECT_EQ(rows_of(*folder / "run", "falls"), ours);
  EXPECT_THAT(read_file(*folder / "run/benchmark.html"), HasSubstr("scope=\"row\">falls</th>"));
}

TEST_F(Submission, ProgramInTheDocumentsIsTheTestedOne) {
  const std::string script = read_file(TOUCHDOWN_SOURCE_DIR "/examples/enter/free_fall.py");
  EXPECT_THAT(read_file(TOUCHDOWN_SOURCE_DIR "/docs/guides/enter.md"),
              HasSubstr("```python\n" + script.substr(script.find("import csv")) + "```\n"));
}

TEST_F(Submission, ScoresAreKeptAndReplacedByName) {
  write_constant(*folder, "signals", "first", "1");
  write_constant(*folder, "signals", "second", "0");
  ran("score run --beliefs first", *folder);
  ran("score run --beliefs second", *folder);
  EXPECT_EQ(rows_of(*folder / "run", "first"), rows_of(*folder / "run", "always_contact"));
  const auto second = rows_of(*folder / "run", "second");
  EXPECT_EQ(second.size(), 8U);
  EXPECT_NE(second, rows_of(*folder / "run", "first"));
  ran("score run --beliefs first --name second", *folder);
  EXPECT_EQ(rows_of(*folder / "run", "second"), rows_of(*folder / "run", "first"));
  // Running the experiment again, merging it and writing its report keep the scores.
  const std::string table = read_file(*folder / "run/tables/benchmark.csv");
  const std::string results = read_file(*folder / "run/tables/results.csv");
  EXPECT_THAT(results, HasSubstr(",step,second,"));
  EXPECT_THAT(ran("run bench.yaml --out run --no-pictures", *folder), HasSubstr("\n  second "));
  EXPECT_EQ(read_file(*folder / "run/tables/benchmark.csv"), table);
  EXPECT_EQ(read_file(*folder / "run/tables/results.csv"), results);
  ran("merge run --no-pictures", *folder);
  EXPECT_EQ(read_file(*folder / "run/tables/benchmark.csv"), table);
  ran("report run", *folder);
  EXPECT_THAT(read_file(*folder / "run/benchmark.html"), HasSubstr("scope=\"row\">second</th>"));
}

TEST_F(Submission, RunsWithoutBeliefsAreNamedAndNotScored) {
  write_constant(*folder, "signals", "part", "1");
  const std::string stem = "upkie/ideal/mujoco_step_test_001_noise_0_seed_1";
  fs::remove(*folder / "part" / (stem + ".csv"));  // one draw of a run's noise
  fs::remove_all(*folder / "part/upkie/harsh");
  const std::string output = ran("score run --beliefs part", *folder);
  EXPECT_THAT(output, AllOf(HasSubstr("part: 7 runs scored"),
                            HasSubstr("No beliefs about 17 files, which are not scored: " + stem)));
  const auto rows = rows_of(*folder / "run", "part");
  ASSERT_EQ(rows.size(), 4U);
  std::map<std::string, int> runs;
  for (const auto& row : rows) ++runs[row.at(3) + " " + row.at(row.size() - 4)];
  EXPECT_EQ(runs, (std::map<std::string, int>{{"roll 2", 2}, {"step 1", 1}, {"step 2", 1}}));
}

TEST_F(Submission, RunsOfSomeScenesAreInTheColumnsOfTheirScenesAndHaveNoMean) {
  write_constant(*folder, "signals", "rolls", "1");
  for (const auto& file : fs::directory_iterator(*folder / "rolls/upkie/ideal")) {
    if (file.path().string().find("_step_") != std::string::npos) fs::remove(file);
  }
  const std::string output = ran("score run --beliefs rolls", *folder);
  EXPECT_THAT(output, ::testing::ContainsRegex("\n  rolls +– +1.000 +– +–\n"));
}

TEST_F(Submission, BeliefsThatAreMissingAreCounted) {
  write_constant(*folder, "signals", "sparse", "1");
  // Of 801 steps all except the first, in four files of ideal sensors for each of two runs.
  const std::string output = ran("score run --beliefs sparse", *folder);
  EXPECT_THAT(output, ::testing::ContainsRegex(
                          "[0-9]+ steps in 32 files have no belief: the previous belief is used"));
}

TEST_F(Submission, FilesThatAreWrongAreRefusedAndChangeNothing) {
  const auto before = result_files(*folder / "run");
  const std::string known = "upkie/ideal/mujoco_step_test_000_noise_0_seed_0";
  const auto complaint = [&](const std::string& name, const std::string& text,
                             const std::string& expected) {
    fs::remove_all(*folder / "wrong");
    write_constant(*folder, "signals", "wrong", "1");
    folder->write("wrong/" + name, text);
    EXPECT_THAT(refused("score run --beliefs wrong", *folder),
                AllOf(HasSubstr("touchdown: wrong/"), HasSubstr(expected)));
  };
  complaint(known + ".csv", "time,p_left,p_rihgt\n",
            known + ".csv:1:13: unknown name 'p_rihgt' (did you mean 'p_right'?)");
  complaint(known + ".csv", "time,p_left,p_right\n99,1,1\n",
            known + ".csv:2: time 99 s: expected one of the run, from 0 to 2.5 s");
  complaint("upkie/ideal/mujoco_step_tst_000_noise_0_seed_0.csv", "",
            "the benchmark has no run of this name (did you mean '" + known + "'?)");
  complaint(known + ".mpack", "", known + ".csv is about the same run: expected one of them");
  EXPECT_THAT(refused("score run --beliefs signals", *folder),
              HasSubstr("README.md: the benchmark has no run of this name"));
  EXPECT_THAT(refused("score run --beliefs nowhere", *folder),
              HasSubstr("nowhere: no such file or folder"));
  EXPECT_THAT(refused("score run --beliefs wrong --name free_fall", *folder),
              HasSubstr("'free_fall' is one of touchdown's own estimators"));
  EXPECT_THAT(refused("score run --beliefs wrong --name ../x", *folder), HasSubstr("--name: "));
  EXPECT_THAT(different_files(result_files(*folder / "run"), before), IsEmpty());
}

TEST_F(Submission, FilesOfOneRunCanBeScoredAlone) {
  folder->write("bullet.yaml",
                "name: once\nsimulators: [bullet]\nestimators: [free_fall]\n"
                "fit: {scenarios: [roll.yaml]}\ntest: {scenarios: [roll.yaml], runs: 1}\n"
                "highlights: [{torque: 0, accelerometer: 0}]\nbenchmark: {}\n"
                "video: {enabled: false}\nrecordings: all\n");
  ran("run bullet.yaml --no-pictures --out once", *folder);
  const std::string name = "bullet_roll_test_000_noise_0_seed_0";
  folder->write(name + ".csv", "time,p_left,p_right\n0,1,1\n");
  ran("score once --name mine --beliefs " + name + ".csv", *folder);
  EXPECT_EQ(rows_of(*folder / "once", "mine"), rows_of(*folder / "once", "always_contact"));
  folder->write("bullet_rol_test_000_noise_0_seed_0.csv", "");
  EXPECT_THAT(refused("score once --beliefs bullet_rol_test_000_noise_0_seed_0.csv", *folder),
              HasSubstr("did you mean '" + name + "'?"));
  folder->write("mujoco_roll_test_002_noise_0_seed_0.csv", "time,p_left,p_right\n0,1,1\n");
  EXPECT_THAT(refused("score run --beliefs mujoco_roll_test_002_noise_0_seed_0.csv", *folder),
              HasSubstr("the benchmark has 2 runs of this name"));
}

TEST_F(Submission, RunsThatFellAreNotExportedAndCountAsFailed) {
  const std::string step = read_file(*folder / "step.yaml");
  folder->write("deep.yaml", std::regex_replace(step, std::regex("rise: 0.25"), "rise: 0.7"));
  folder->write("falls.yaml",
                "name: falls\nseed: 3\nsimulators: [mujoco]\nestimators: [free_fall]\n"
                "fit: {scenarios: [step.yaml]}\ntest: {scenarios: [deep.yaml], runs: 6}\n"
                "highlights: [{torque: 0, accelerometer: 0}]\nbenchmark: {}\nrecordings: none\n"
                "video: {enabled: false}\n");
  ran("run falls.yaml --no-pictures --out fell", *folder);
  const auto ours = rows_of(*folder / "fell", "always_contact");
  ASSERT_EQ(ours.size(), 1U);
  const std::size_t failed = std::stoul(ours[0].at(ours[0].size() - 3));
  ASSERT_GT(failed, 0U) << "no robot falls down this step any more";
  ran("export --benchmark upright fell", *folder);
  EXPECT_EQ(from_csv(read_file(*folder / "upright/index.csv")).rows.size(), 7U - failed);
  write_constant(*folder, "upright", "stays", "1");
  EXPECT_THAT(ran("score fell --beliefs stays", *folder), Not(HasSubstr("not scored: upkie")));
  EXPECT_EQ(rows_of(*folder / "fell", "stays"), ours);
}

TEST_F(Submission, UnfinishedBenchmarksAndOtherRunsAreRefused) {
  EXPECT_THAT(refused("score nowhere --beliefs signals", *folder),
              HasSubstr("nowhere: holds no part of an experiment"));
  ran("run tiny.yaml --no-pictures --out tiny", *folder);
  EXPECT_THAT(refused("score tiny --beliefs signals", *folder),
              HasSubstr("experiment 'tiny' is no benchmark: expected a section 'benchmark'"));
  EXPECT_THAT(refused("export --benchmark x tiny.yaml", *folder), HasSubstr("is no benchmark"));
  ran("run bench.yaml --no-pictures --shard 1/2 --out half", *folder);
  EXPECT_THAT(refused("score half --beliefs signals", *folder),
              HasSubstr("half: is not finished: run the same experiment again first"));
}

TEST_F(Submission, ExportsAreTheSameBytesFromARunAndFromItsExperimentOnAnyThreads) {
  ran("export --benchmark again bench.yaml", *folder);
  EXPECT_THAT(different_files(result_files(*folder / "signals"), result_files(*folder / "again")),
              IsEmpty());
  std::string text = read_file(*folder / "bench.yaml");
  folder->write("one_thread.yaml", text + "workers: 1\n");
  ran("export --benchmark one_thread one_thread.yaml", *folder);
  EXPECT_THAT(
      different_files(result_files(*folder / "signals"), result_files(*folder / "one_thread")),
      IsEmpty());
  EXPECT_TRUE(shell("cd signals && sha256sum --check --strict --quiet SHA256SUMS", *folder));
  const TextTable index = from_csv(read_file(*folder / "signals/index.csv"));
  EXPECT_THAT(index.header, ElementsAre("file", "robot", "sensors", "simulator", "role", "scene",
                                        "run", "noise", "seed", "torque_noise_nm",
                                        "accelerometer_noise_mps2", "steps", "control_period_s"));
  // For each kind of sensors a fitted run and four tested ones, with two noises and draws of each.
  ASSERT_EQ(index.rows.size(), 2U * (1 + 4 * 4));
  for (const auto& row : index.rows) EXPECT_TRUE(fs::exists(*folder / "signals" / row.at(0)));
  EXPECT_EQ(names_in(*folder / "signals"),
            (std::set<std::string>{"README.md", "SHA256SUMS", "index.csv", "upkie"}));
}

TEST_F(Submission, ExportsAreTheSameBytesFromRecordingsAndWhereTheseAreGone) {
  const std::string text = read_file(*folder / "bench.yaml");
  folder->write("kept.yaml",
                std::regex_replace(text, std::regex("recordings: none"), "recordings: all"));
  ran("run kept.yaml --no-pictures --out kept", *folder);
  ran("export --benchmark recorded kept", *folder);
  fs::remove_all(*folder / "kept/recordings");
  ran("export --benchmark simulated kept", *folder);
  const auto recorded = result_files(*folder / "recorded");
  EXPECT_THAT(different_files(recorded, result_files(*folder / "simulated")), IsEmpty());
  EXPECT_FALSE(fs::exists(*folder / "kept/recordings"));
  // The README names the request's digest, which differs. The signals are the same.
  EXPECT_THAT(different_files(recorded, result_files(*folder / "signals")),
              ElementsAre("README.md", "SHA256SUMS"));
}

TEST_F(Submission, PartsOfAnExportAreChosenByName) {
  ran("export --benchmark harsh run --sensors harsh --robot upkie --simulator mujoco", *folder);
  EXPECT_EQ(names_in(*folder / "harsh/upkie"), std::set<std::string>{"harsh"});
  const std::string outline = ran("export --benchmark no run --sensors harsh --dry-run", *folder);
  EXPECT_THAT(outline, ::testing::ContainsRegex("\n  upkie +harsh +mujoco +1 +16 +"));
  EXPECT_THAT(outline, Not(HasSubstr("ideal")));
  EXPECT_FALSE(fs::exists(*folder / "no"));
  EXPECT_THAT(refused("export --benchmark no run --sensors harhs", *folder),
              HasSubstr("--sensors: the benchmark has no 'harhs': expected one of ideal, harsh "
                        "(did you mean 'harsh'?)"));
  EXPECT_THAT(refused("export --benchmark signals run", *folder), HasSubstr("signals: holds '"));
  EXPECT_THAT(refused("export --benchmark bench.yaml run", *folder),
              HasSubstr("bench.yaml: is no folder"));
  EXPECT_THAT(refused("export --benchmark no nowhere.yaml", *folder), HasSubstr("nowhere.yaml"));
}

TEST(Export, ThatIsInterruptedLeavesNothing) {
  const ScratchFolder folder;
  write_long_experiment(folder);
  folder.write("x.yaml", read_file(folder / "x.yaml") + "benchmark: {}\n");
  fs::create_directory(folder / "empty");
  for (const char* out : {"new", "empty"}) {
    StartedProgram program(std::string("export --benchmark ") + out + " x.yaml", folder.path());
    while (program.is_running() && (!fs::exists(folder / out) || fs::is_empty(folder / out))) {
      program.let_run(0.002);
    }
    program.let_run(0.05);
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.errors, HasSubstr("touchdown: stopped; nothing was written\n"));
  }
  EXPECT_FALSE(fs::exists(folder / "new"));
  EXPECT_TRUE(fs::is_empty(folder / "empty"));
}

TEST(Export, ThatExceedsTheDiskIsRefusedBeforeItBegins) {
  const ScratchFolder folder;
  write_benchmark(folder);
  folder.write("roll.yaml", "name: roll\nend: {duration: 100000}\n");
  const std::string text = read_file(folder / "bench.yaml");
  folder.write("bench.yaml", std::regex_replace(text, std::regex("runs: 2"), "runs: 1000"));
  const Ended ended = touchdown_program("export --benchmark signals bench.yaml", folder.path());
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.errors, AllOf(HasSubstr("this export may need"), HasSubstr("choose a part")));
  EXPECT_FALSE(fs::exists(folder / "signals"));
}

}  // namespace
}  // namespace touchdown::cli
