#include "tests/cli/started_program.hpp"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <regex>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "core/files.hpp"

namespace touchdown::cli {

int exit_code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status); }

std::vector<std::string> messages_in(const std::string& errors) {
  static const std::regex progress(R"([a-z ]+: \d+/\d+ .*)");
  std::vector<std::string> lines;
  std::istringstream text(errors);
  for (std::string line; std::getline(text, line);) {
    if (!std::regex_match(line, progress)) lines.push_back(line);
  }
  return lines;
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
  return {exit_code_of(status_), read_file(out_), read_file(err_)};
}

void StartedProgram::wait(int flags) {
  if (!ended_) ended_ = ::waitpid(process_, &status_, flags) == process_;
}

}  // namespace touchdown::cli
