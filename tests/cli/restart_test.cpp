#include <csignal>
#include <cstdlib>
#include <functional>
#include <random>
#include <sys/wait.h>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "result_files.hpp"
#include "started_program.hpp"

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

/// Runs the program to its end and returns its messages on standard error.
std::string run_through(const std::string& arguments, const ScratchFolder& folder) {
  const Ended ended = touchdown_program(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  return ended.errors;
}

TEST(Restart, AfterKillsAtRandomMomentsEndsInTheBytesOfAnUndisturbedRun) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out ";
  run_through(run + "undisturbed", folder);
  const auto expected = result_files(folder / "undisturbed");
  ASSERT_EQ(expected.count("tables/success.csv"), 1U);
  // Moments by the run's progress: a busy machine changes its duration.
  std::mt19937 random(20261121);
  std::uniform_int_distribution<std::size_t> moment(0, files_written(folder / "undisturbed") - 1);
  std::uniform_real_distribution<double> later(0.0, 0.1);  // s
  int kills = 0;
  for (const std::string out : {"a", "b", "c"}) {
    for (int attempt = 0; attempt < 3; ++attempt) {
      StartedProgram program(run + out, folder.path());
      const std::size_t written = moment(random);
      while (program.is_running() && files_written(folder / out) < written) program.let_run(0.002);
      program.let_run(later(random));
      program.send(SIGKILL);
      if (program.end().exit_code == -SIGKILL) ++kills;
    }
    run_through(run + out, folder);
    EXPECT_THAT(different_files(result_files(folder / out), expected), IsEmpty()) << out;
  }
  EXPECT_GT(kills, 0);
}

TEST(Restart, ComputesDamagedPartsAgain) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out a";
  run_through(run, folder);
  const auto expected = result_files(folder / "a");
  const std::vector<fs::path> parts = saved_parts(folder / "a");
  ASSERT_EQ(parts.size(), 12U);
  fs::resize_file(parts[2], fs::file_size(parts[2]) / 2);
  std::string content = read_file(parts[7]);
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 4);
  write_atomically(parts[7], content);
  const Ended merge = touchdown_program("merge a --no-pictures", folder.path());
  EXPECT_EQ(merge.exit_code, 2);
  EXPECT_THAT(merge.errors, HasSubstr("2 of 12 parts are missing"));
  const fs::path recording = folder / "a/recordings/bullet_step_test_001.mpack";
  fs::resize_file(recording, fs::file_size(recording) - 1);
  const std::vector<fs::file_time_type> written = [&] {
    std::vector<fs::file_time_type> times;
    for (const fs::path& part : parts) times.push_back(fs::last_write_time(part));
    return times;
  }();
  EXPECT_THAT(run_through(run, folder), HasSubstr("12/12 parts (10 of them done before)"));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(fs::last_write_time(parts[i]) == written[i], i != 2 && i != 7) << parts[i];
  }
  EXPECT_THAT(different_files(result_files(folder / "a"), expected), IsEmpty());
}

TEST(Interrupt, WhileStandardInputIsSilentIsNoEmptyLog) {
  const ScratchFolder folder;
  for (const std::string arguments : {"check -", "fit - -o m.npz", "export - -o x.mcap"}) {
    const std::string command = "cd '" + folder.path().string() +
                                "' && timeout 3 tail -f /dev/null | timeout --preserve-status -s "
                                "INT 1 '" TOUCHDOWN_PROGRAM "' " +
                                arguments + " >/dev/null 2>.stderr";
    const int status = std::system(command.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    constexpr int ended_by_signal = 128 + SIGINT;  // on a busy machine, before it can react
    if (code == ended_by_signal) continue;
    EXPECT_EQ(code, 1) << arguments;
    EXPECT_THAT(read_file(folder / ".stderr"), ::testing::StartsWith("touchdown: stopped"));
  }
}

TEST(Interrupt, EndsIntervalsAndDrawsOfScenarios) {
  const ScratchFolder folder;
  const auto stopped = [&](const std::string& arguments, const std::function<bool()>& has_begun) {
    StartedProgram program(arguments, folder.path());
    while (program.is_running() && !has_begun()) program.let_run(0.002);
    program.send(SIGINT);
    return program.end();
  };
  // A million resamples take minutes. They begin after the last part of the evaluation.
  const Ended run = stopped("run " + write_tiny_experiment(folder) +
                                " --no-pictures --out a --set intervals.resamples=1000000",
                            [&] { return saved_parts(folder / "a").size() == 12; });
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors, ContainsRegex("stopped; 8 of 8 recordings and (all )?12"));
  EXPECT_FALSE(fs::exists(folder / "a/tables/success.csv"));
  int waits = 0;
  const Ended draws = stopped("generate --count 100000 -o scenes", [&] { return ++waits > 200; });
  // On a busy machine the program may still be loading its libraries.
  if (draws.exit_code != -SIGINT) {
    EXPECT_EQ(draws.exit_code, 1);
    EXPECT_THAT(draws.errors, HasSubstr("stopped; nothing was written"));
  }
  EXPECT_FALSE(fs::exists(folder / "scenes"));
}

TEST(Restart, AtAnotherPlaceContinuesARunWithADirectoryThatWasMoved) {
  const ScratchFolder folder;
  const std::string run =
      "run " + write_tiny_experiment(folder) + " --no-pictures --set noise.seeds=40 --out ";
  StartedProgram program(run + "a --set workers=1", folder.path());
  while (program.is_running() && saved_parts(folder / "a").size() < 2) program.let_run(0.002);
  fs::rename(folder / "a", folder / "b");
  const Ended ended = program.end();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.errors, HasSubstr("a: was moved or removed during the run"));
  EXPECT_FALSE(fs::exists(folder / "a/tables"));
  const auto parts = saved_parts(folder / "b");
  ASSERT_FALSE(parts.empty());
  const fs::file_time_type written = fs::last_write_time(parts.front());
  run_through(run + "b --set workers=1", folder);
  EXPECT_EQ(fs::last_write_time(parts.front()), written);
  EXPECT_TRUE(fs::exists(folder / "b/tables/success.csv"));
}

// Whatever the moment: while the log is read, while frames are drawn, while records are written.
TEST(Interrupt, OfACommandWithOneOutputWritesNothing) {
  const ScratchFolder folder;
  write_long_experiment(folder);
  folder.write("step.yaml",
               "name: step\nterrain: {pieces: [{flat: {length: 2.0}}, "
               "{step: {drop: 0.2, nosing_radius: 0.025}}, {flat: {length: 12.0}}]}\n"
               "velocity: [{time: 0.3, velocity: 0.6}]\nend: {duration: 15.0}\n");
  ASSERT_EQ(touchdown_program("simulate step.yaml -o a.mpack", folder.path()).exit_code, 0);
  int stopped = 0;
  for (const std::string arguments :
       {"simulate long.yaml -o out.mpack", "render a.mpack -o out.mp4",
        "export a.mpack -o out.mcap", "estimate a.mpack -o out.csv",
        "fit a.mpack --skip 0 -o out.npz"}) {
    const std::string output = arguments.substr(arguments.rfind(' ') + 1);
    for (const double after : {0.05, 0.2, 0.5}) {
      StartedProgram program(arguments, folder.path());
      program.wait_for_handler(SIGTERM);
      program.let_run(after);
      program.send(SIGTERM);
      const Ended ended = program.end();
      if (ended.exit_code == 0) {  // it had ended
        fs::remove(folder / output);
        continue;
      }
      EXPECT_EQ(ended.exit_code, 1) << arguments << ", after " << after << " s";
      ++stopped;
      EXPECT_THAT(ended.errors,
                  ContainsRegex("touchdown: stopped; no(thing| model) was written\n$"))
          << arguments << ", after " << after << " s";
      EXPECT_FALSE(fs::exists(folder / output)) << arguments;
    }
  }
  EXPECT_GT(stopped, 0);
}

TEST(Interrupt, ReportsWhatIsSavedAndTheSameCommandContinues) {
  const ScratchFolder folder;
  const std::string run =
      "run " + write_tiny_experiment(folder) + " --no-pictures --set noise.seeds=15 --out ";
  std::vector<fs::path> parts;
  std::vector<fs::file_time_type> written;
  {
    StartedProgram program(run + "a --set workers=1", folder.path());
    while (program.is_running() && saved_parts(folder / "a").size() < 2) program.let_run(0.002);
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.output, "");
    parts = saved_parts(folder / "a");
    EXPECT_LT(parts.size(), 90U);
    EXPECT_THAT(
        ended.errors,
        HasSubstr("touchdown: stopped; 8 of 8 recordings and " + std::to_string(parts.size()) +
                  " of 90 parts of the evaluation are saved in a; the same command "
                  "continues from there\n"));
  }
  for (const fs::path& part : parts) written.push_back(fs::last_write_time(part));
  EXPECT_THAT(run_through(run + "a", folder),
              HasSubstr("90/90 parts (" + std::to_string(parts.size()) + " of them done before)"));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(fs::last_write_time(parts[i]), written[i]);
  }
  run_through(run + "undisturbed", folder);
  EXPECT_THAT(different_files(result_files(folder / "a"), result_files(folder / "undisturbed")),
              IsEmpty());
}

TEST(Interrupt, InFiguresAndFilmsLosesNothingComputed) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder);
  struct Stage {
    std::string name, options, all_parts;
    bool films = false;  // they follow the last figure
  };
  const Stage stages[] = {
      {"figures", "", "12/12 parts (12 of them done before)"},
      {"videos", " --set video.enabled=true --set simulators=[mujoco]",  // fewer films
       "6/6 parts (6 of them done before)", true}};
  for (const Stage& stage : stages) {
    const std::string command = run + stage.options + " --out ";
    run_through(command + stage.name, folder);
    const std::size_t figures =
        stage.films ? entries_in(folder / stage.name / "figures").size() : 1;
    const auto expected = result_files(folder / stage.name);
    int interrupted = 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      const std::string out = fmt::format("{}_{}", stage.name, signal);
      StartedProgram program(command + out, folder.path());
      while (program.is_running() && entries_in(folder / out / "figures").size() < figures) {
        program.let_run(0.002);
      }
      if (stage.films) program.let_run(0.2);
      program.send(signal);
      const Ended ended = program.end();
      if (ended.exit_code != 0) {  // else it had drawn everything
        ++interrupted;
        EXPECT_EQ(ended.exit_code, 1) << out;
        EXPECT_THAT(ended.errors, HasSubstr("touchdown: stopped; ")) << out;
      }
      EXPECT_THAT(run_through(command + out, folder), HasSubstr(stage.all_parts)) << out;
      EXPECT_THAT(different_files(result_files(folder / out), expected), IsEmpty()) << out;
    }
    EXPECT_GT(interrupted, 0) << stage.name;
  }
}

TEST(Interrupt, BeforeAnythingIsSavedReportsThat) {
  const ScratchFolder folder;
  StartedProgram program("run " + write_long_experiment(folder) + " --out a", folder.path());
  while (program.is_running() && !fs::exists(folder / "a/state/key")) program.let_run(0.002);
  program.let_run(0.05);
  program.send(SIGINT);
  const Ended ended = program.end();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.errors, ContainsRegex("stopped; 0 of [0-9]+ recordings and 0 of [0-9]+ parts"));
}

}  // namespace
}  // namespace touchdown::cli
