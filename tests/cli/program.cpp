#include "program.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <regex>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace touchdown::cli {

namespace {

int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status); }

}  // namespace

std::vector<std::string> messages_in(const std::string& errors) {
  static const std::regex progress(R"([a-z ]+: \d+/\d+ .*)");
  std::vector<std::string> lines;
  std::istringstream text(errors);
  for (std::string line; std::getline(text, line);) {
    if (!std::regex_match(line, progress)) lines.push_back(line);
  }
  return lines;
}

Ended ProgramFolder::run(const std::string& arguments, const std::string& shell) const {
  const std::string command =
      fmt::format("cd '{}' && {{ {} exec '" TOUCHDOWN_PROGRAM "' {}; }} >.stdout 2>.stderr",
                  path().string(), shell, arguments);
  const int status = std::system(command.c_str());
  return {exit_code(status), text(".stdout"), text(".stderr")};
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
video: {enabled: false}
recordings: all
)");
  return "tiny.yaml";
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

StartedProgram::StartedProgram(const std::string& arguments, const std::filesystem::path& folder,
                               std::vector<std::string> environment)
    : out_(folder / ".started.stdout"), err_(folder / ".started.stderr") {
  std::vector<std::string> words = {TOUCHDOWN_PROGRAM};
  std::istringstream rest(arguments);
  for (std::string word; rest >> word;) words.push_back(word);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::vector<char*> variables;
  for (std::string& variable : environment) variables.push_back(variable.data());
  for (char** variable = environ; *variable != nullptr; ++variable) variables.push_back(*variable);
  variables.push_back(nullptr);
  process_ = ::fork();
  if (process_ != 0) return;
  // Nothing here may allocate.
  constexpr int mode = 0600;
  ::dup2(::open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode), STDOUT_FILENO);
  ::dup2(::open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode), STDERR_FILENO);
  if (::chdir(folder.c_str()) == 0) ::execve(argv.front(), argv.data(), variables.data());
  ::_exit(127);
}

StartedProgram::~StartedProgram() {
  if (!is_running()) return;
  send(SIGKILL);
  wait(0);
}

void StartedProgram::send(int signal) const {
  if (!ended_) ::kill(process_, signal);
}

bool StartedProgram::is_running() {
  wait(WNOHANG);
  return !ended_;
}

void StartedProgram::wait_for_handler(int signal) {
  const auto is_handled = [&] {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (!line.starts_with("SigCgt:")) continue;  // proc(5): a mask; bit 0 is signal 1
      return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1U) != 0U;
    }
    return false;
  };
  while (is_running() && !is_handled()) let_run(0.001);
}

void StartedProgram::let_run(double seconds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (is_running() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

Ended StartedProgram::end() {
  wait(0);
  return {exit_code(status_), read_file(out_), read_file(err_)};
}

void StartedProgram::wait(int flags) {
  if (!ended_) ended_ = ::waitpid(process_, &status_, flags) == process_;
}

}  // namespace touchdown::cli
