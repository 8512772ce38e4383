#include <array>
#include <csignal>
#include <functional>
#include <random>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "tests/cli/result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

std::vector<fs::path> saved_parts(const fs::path& run_directory) {
  std::vector<fs::path> parts;
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(run_directory / "state" / "evaluation", ignored)) {
    if (entry.path().filename().string().rfind('.', 0) != 0) parts.push_back(entry.path());
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

/// The number of files in a folder and below, while a program writes there.
std::size_t files_written(const fs::path& folder) {
  std::size_t files = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator i(folder, error), end; !error && i != end;
       i.increment(error)) {
    if (i->is_regular_file(error)) ++files;
    error.clear();
  }
  return files;
}

/// A folder with the tiny experiment.
struct Restart : InFolder {
  Restart() : InFolder(true) {}

  const std::string run = "run " + write_tiny_experiment(folder_) + " --out ";
  const std::string run_without_pictures = "run tiny.yaml --no-pictures --out ";
};
using Interrupt = Restart;

std::vector<fs::file_time_type> times_of(const std::vector<fs::path>& files) {
  std::vector<fs::file_time_type> times;
  for (const fs::path& file : files) times.push_back(fs::last_write_time(file));
  return times;
}

TEST_F(Restart, AfterKillsAtRandomMomentsEndsInTheBytesOfAnUndisturbedRun) {
  folder_.output_of(run + "undisturbed");
  const auto expected = result_files(folder_ / "undisturbed");
  ASSERT_EQ(expected.count("tables/success.csv"), 1U);
  // Moments by the run's progress: a busy machine changes its duration.
  std::mt19937 random(20261121);
  std::uniform_int_distribution<std::size_t> moment(0, files_written(folder_ / "undisturbed") - 1);
  std::uniform_real_distribution<double> later(0.0, 0.1);  // s
  int kills = 0;
  for (const std::string out : {"a", "b", "c"}) {
    for (int attempt = 0; attempt < 3; ++attempt) {
      StartedProgram program(run + out, folder_.path());
      const std::size_t written = moment(random);
      program.let_run_until([&] { return files_written(folder_ / out) >= written; });
      program.let_run(later(random));
      program.send(SIGKILL);
      if (program.end().exit_code == -SIGKILL) ++kills;
    }
    folder_.output_of(run + out);
    EXPECT_THAT(different_files(result_files(folder_ / out), expected), IsEmpty()) << out;
  }
  EXPECT_GT(kills, 0);
}

TEST_F(Restart, ComputesDamagedPartsAgain) {
  folder_.output_of(run_without_pictures + "a");
  const auto expected = result_files(folder_ / "a");
  const std::vector<fs::path> parts = saved_parts(folder_ / "a");
  ASSERT_EQ(parts.size(), 12U);
  fs::resize_file(parts[2], fs::file_size(parts[2]) / 2);
  std::string content = read_file(parts[7]);
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 4);
  write_atomically(parts[7], content);
  const fs::path recording = folder_ / "a/recordings/bullet_step_test_001.mpack";
  fs::resize_file(recording, fs::file_size(recording) - 1);
  const std::vector<fs::file_time_type> written = times_of(parts);
  EXPECT_THAT(folder_.messages_of(run_without_pictures + "a"),
              HasSubstr("4 of 6 runs were evaluated before"));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(fs::last_write_time(parts[i]) == written[i], i != 2 && i != 7) << parts[i];
  }
  EXPECT_THAT(different_files(result_files(folder_ / "a"), expected), IsEmpty());
}

TEST_F(Interrupt, WhileStandardInputIsSilentIsNoEmptyLog) {
  std::array<int, 2> silent = {};
  ASSERT_EQ(::pipe(silent.data()), 0);
  ::dup2(silent[0], STDIN_FILENO);  // which programs inherit
  for (const std::string arguments : {"check -", "fit - -o m.npz", "convert - -o x.mcap"}) {
    StartedProgram program(arguments, folder_.path());
    program.wait_for_handler(SIGINT);
    program.let_run(0.2);
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_THAT(ended.errors, ::testing::StartsWith("touchdown: stopped"));
  }
}

TEST_F(Interrupt, EndsIntervalsAndDrawsOfScenarios) {
  const auto stopped = [&](const std::string& arguments, const std::function<bool()>& has_begun) {
    StartedProgram program(arguments, folder_.path());
    program.let_run_until(has_begun);
    program.send(SIGINT);
    return program.end();
  };
  // A million resamples take minutes. They begin after the last part of the evaluation.
  const Ended intervals = stopped(run_without_pictures + "a --set intervals.resamples=1000000",
                                  [&] { return saved_parts(folder_ / "a").size() == 12; });
  EXPECT_EQ(intervals.exit_code, 1);
  EXPECT_THAT(intervals.errors, ContainsRegex("stopped; 8 of 8 recordings and (all )?12"));
  EXPECT_FALSE(folder_.has("a/tables/success.csv"));
  int waits = 0;
  const Ended draws = stopped("generate --count 100000 -o scenes", [&] { return ++waits > 200; });
  // On a busy machine the program may still be loading its libraries.
  if (draws.exit_code != -SIGINT) {
    EXPECT_EQ(draws.exit_code, 1);
    EXPECT_THAT(draws.errors, HasSubstr("stopped; nothing was written"));
  }
  EXPECT_FALSE(folder_.has("scenes"));
}

TEST_F(Restart, AtAnotherPlaceContinuesARunWithADirectoryThatWasMoved) {
  const std::string flags = " --set noise.seeds=40 --set workers=1";
  StartedProgram program(run_without_pictures + "a" + flags, folder_.path());
  program.let_run_until([&] { return saved_parts(folder_ / "a").size() >= 2; });
  fs::rename(folder_ / "a", folder_ / "b");
  const Ended ended = program.end();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.errors, HasSubstr("a: was moved or removed during the run"));
  EXPECT_FALSE(folder_.has("a/tables"));
  const auto parts = saved_parts(folder_ / "b");
  ASSERT_FALSE(parts.empty());
  const fs::file_time_type written = fs::last_write_time(parts.front());
  folder_.output_of(run_without_pictures + "b" + flags);
  EXPECT_EQ(fs::last_write_time(parts.front()), written);
  EXPECT_TRUE(folder_.has("b/tables/success.csv"));
}

// Whatever the moment: while the log is read, while frames are drawn, while records are written.
TEST_F(Interrupt, OfACommandWithOneOutputWritesNothing) {
  write_long_experiment(folder_);
  folder_.write("step.yaml",
                "name: step\nterrain: {pieces: [{flat: {length: 2.0}}, "
                "{step: {drop: 0.2, nosing_radius: 0.025}}, {flat: {length: 12.0}}]}\n"
                "velocity: [{time: 0.3, velocity: 0.6}]\nend: {duration: 15.0}\n");
  folder_.output_of("simulate step.yaml -o a.mpack");
  int stopped = 0;
  for (const std::string arguments :
       {"simulate long.yaml -o out.mpack", "render a.mpack -o out.mp4",
        "convert a.mpack -o out.mcap", "estimate a.mpack -o out.csv",
        "fit a.mpack --skip 0 --no-accuracy --grid 2000 2000 -o out.npz"}) {
    const std::string output = arguments.substr(arguments.rfind(' ') + 1);
    for (const double after : {0.05, 0.2, 0.5}) {
      StartedProgram program(arguments, folder_.path());
      program.wait_for_handler(SIGTERM);
      program.let_run(after);
      program.send(SIGTERM);
      const Ended ended = program.end();
      if (ended.exit_code == 0) {  // it had ended
        fs::remove(folder_ / output);
        continue;
      }
      EXPECT_EQ(ended.exit_code, 1) << arguments << ", after " << after << " s";
      ++stopped;
      EXPECT_THAT(ended.errors,
                  ContainsRegex("touchdown: stopped; no(thing| model) was written\n$"))
          << arguments << ", after " << after << " s";
      EXPECT_FALSE(folder_.has(output)) << arguments;
    }
  }
  EXPECT_GT(stopped, 0);
}

TEST_F(Interrupt, ReportsWhatIsSavedAndTheSameCommandContinues) {
  const std::string flags = " --set noise.seeds=15 --set workers=1";
  StartedProgram program(run_without_pictures + "a" + flags, folder_.path());
  program.let_run_until([&] { return saved_parts(folder_ / "a").size() >= 2; });
  program.send(SIGINT);
  const Ended ended = program.end();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.output, "");
  const std::vector<fs::path> parts = saved_parts(folder_ / "a");
  EXPECT_LT(parts.size(), 90U);
  EXPECT_THAT(ended.errors,
              ContainsRegex(fmt::format(
                  "touchdown: stopped; [3-8] of 8 recordings and {} of 90 parts of the evaluation "
                  "are saved in a; the same command continues from there\n",
                  parts.size())));
  const std::vector<fs::file_time_type> written = times_of(parts);
  folder_.output_of(run_without_pictures + "a" + flags);
  EXPECT_EQ(times_of(parts), written);
  folder_.output_of(run_without_pictures + "undisturbed" + flags);
  EXPECT_THAT(different_files(folder_ / "a", folder_ / "undisturbed"), IsEmpty());
}

TEST_F(Interrupt, InFiguresAndFilmsLosesNothingComputed) {
  struct Stage {
    std::string name, options, all_runs;
    bool films = false;  // they follow the last figure
  };
  const Stage stages[] = {
      {"figures", "", "6 of 6 runs were evaluated before"},
      {"videos", " --set video.enabled=true --set simulators=[mujoco]",  // fewer films
       "3 of 3 runs were evaluated before", true}};
  for (const Stage& stage : stages) {
    const std::string command = "run tiny.yaml" + stage.options + " --out ";
    folder_.output_of(command + stage.name);
    const std::size_t figures =
        stage.films ? entries_in(folder_ / stage.name / "figures").size() : 1;
    const auto expected = result_files(folder_ / stage.name);
    int interrupted = 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      const std::string out = fmt::format("{}_{}", stage.name, signal);
      StartedProgram program(command + out, folder_.path());
      program.let_run_until(
          [&] { return entries_in(folder_ / out / "figures").size() >= figures; });
      if (stage.films) program.let_run(0.2);
      program.send(signal);
      const Ended ended = program.end();
      if (ended.exit_code != 0) {  // else it had drawn everything
        ++interrupted;
        EXPECT_EQ(ended.exit_code, 1) << out;
        EXPECT_THAT(ended.errors, HasSubstr("touchdown: stopped; ")) << out;
      }
      EXPECT_THAT(folder_.messages_of(command + out), HasSubstr(stage.all_runs)) << out;
      EXPECT_THAT(different_files(result_files(folder_ / out), expected), IsEmpty()) << out;
    }
    EXPECT_GT(interrupted, 0) << stage.name;
  }
}

TEST_F(Interrupt, BeforeAnythingIsSavedReportsThat) {
  StartedProgram program("run " + write_long_experiment(folder_) + " --out a", folder_.path());
  program.let_run_until([&] { return folder_.has("a/state/key"); });
  program.let_run(0.05);
  program.send(SIGINT);
  const Ended ended = program.end();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.errors, ContainsRegex("stopped; 0 of [0-9]+ recordings and 0 of [0-9]+ parts"));
}

}  // namespace
}  // namespace touchdown::cli
