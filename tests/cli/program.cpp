#include "tests/cli/program.hpp"

#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <map>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/cli/command_line.hpp"
#include "core/fingerprint.hpp"

namespace touchdown::cli {

namespace {

/// A child has one thread only: what others have locked stays locked there.
bool has_threads() {
  const std::filesystem::directory_iterator threads("/proc/self/task");
  return std::distance(begin(threads), end(threads)) > 1;
}

void redirect(const std::string& file, int stream) {
  constexpr int mode = 0600;
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode);
  ::dup2(descriptor, stream);
  ::close(descriptor);
}

/// No exit code of the program.
constexpr int needs_shell = 99;

/// Calls the program's function in `folder`, and ends this process. Returns if the command needs a
/// shell.
void end_as_program(const std::string& command, const std::filesystem::path& folder) {
  std::filesystem::current_path(folder);
  wordexp_t words = {};
  if (::wordexp(command.c_str(), &words, WRDE_NOCMD) != 0) return;
  redirect(".stdout", STDOUT_FILENO);
  redirect(".stderr", STDERR_FILENO);
  const int code = run_program(static_cast<int>(words.we_wordc), words.we_wordv);
  std::cout.flush();
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

Ended ProgramFolder::run(const std::string& arguments) const {
  if (executes_ || has_threads()) return execute(arguments);
  build_fingerprint();  // known to all children
  std::fflush(nullptr);
  const pid_t process = ::fork();
  if (process == 0) {
    end_as_program("'" TOUCHDOWN_PROGRAM "' " + arguments, path());
    ::_exit(needs_shell);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == needs_shell) return execute(arguments);
  return {exit_code_of(status), text(".stdout"), text(".stderr")};
}

Ended ProgramFolder::execute(const std::string& arguments, const std::string& shell) const {
  const std::string command =
      fmt::format("cd '{}' && {{ {} exec '" TOUCHDOWN_PROGRAM "' {}; }} >.stdout 2>.stderr",
                  path().string(), shell, arguments);
  return {exit_code_of(std::system(command.c_str())), text(".stdout"), text(".stderr")};
}

std::string ProgramFolder::output_of(const std::string& arguments) const {
  const Ended ended = run(arguments);
  EXPECT_EQ(ended.exit_code, 0) << arguments << ": " << ended.errors;
  return ended.output;
}

std::string ProgramFolder::messages_of(const std::string& arguments) const {
  const Ended ended = run(arguments);
  EXPECT_EQ(ended.exit_code, 0) << arguments << ": " << ended.errors;
  return ended.errors;
}

std::string ProgramFolder::refusal_of(const std::string& arguments, int exit_code) const {
  const Ended ended = run(arguments);
  EXPECT_EQ(ended.exit_code, exit_code) << arguments << ": " << ended.errors;
  EXPECT_EQ(ended.output, "") << arguments;
  const std::vector<std::string> messages = messages_in(ended.errors);
  EXPECT_EQ(messages.size(), 1U) << arguments << ": " << ended.errors;
  const std::string line = messages.empty() ? "" : messages.front() + "\n";
  EXPECT_THAT(line, ::testing::StartsWith("touchdown: ")) << arguments;
  return line;
}

void ProgramFolder::fill(const std::string& name,
                         const std::function<void(const ProgramFolder&)>& make) const {
  static std::map<std::string, ProgramFolder> made;
  const auto [found, is_new] = made.try_emplace(name);
  if (is_new) make(found->second);
  std::filesystem::copy(
      found->second.path(), path(),
      std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
}

void ProgramFolder::expect_refusals(const std::vector<Refusal>& refusals, int exit_code) const {
  for (const auto& [arguments, texts] : refusals) {
    const std::string line = refusal_of(arguments, exit_code);
    for (const std::string& expected : texts) {
      EXPECT_THAT(line, ::testing::HasSubstr(expected)) << arguments;
    }
  }
}

std::string write_tiny_experiment(const ScratchFolder& folder) {
  folder.write("step.yaml", R"(name: step
terrain:
  pieces:
    - flat: {length: 3.0}
    - stairs: {count: 1, run: 3.0, rise: 0.25, nosing_radius: 0.025}
start: {x: 0.7}
velocity: [{time: 0.3, velocity: 0.5}]
end: {duration: 2.5}
perturbation: {velocity: 0.1, yaw: 0.05}
)");
  folder.write("tiny.yaml", R"(name: tiny
seed: 3
simulators: [mujoco, bullet]
estimators: [robust, measurement_only, upkie_observer]
fit: {scenarios: [step.yaml]}
test: {scenarios: [step.yaml], runs: 3}
noise: {torque: [0.0, 1.0], accelerometer: [0.0, 5.0], seeds: 2}
highlights: [{torque: 1.0, accelerometer: 5.0}]
intervals: {resamples: 100}
video: {enabled: false, width: 320}
recordings: all
)");
  return "tiny.yaml";
}

void write_finished_run(const ProgramFolder& folder, const std::string& flags) {
  folder.fill(flags, [&](const ProgramFolder& made) {
    made.output_of("run " + write_tiny_experiment(made) + " --out a " + flags);
  });
}

std::string write_long_experiment(const ScratchFolder& folder) {
  folder.write("long.yaml", R"(name: long
terrain: {pieces: [{flat: {length: 9.0}}]}
start: {x: 0.7}
end: {duration: 600.0}
perturbation: {yaw: 0.05}
)");
  folder.write("x.yaml",
               "name: x\nfit: {scenarios: [long.yaml]}\ntest: {scenarios: [long.yaml]}\n");
  return "x.yaml";
}

}  // namespace touchdown::cli
