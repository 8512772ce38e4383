#include <cstdio>

#include <fmt/format.h>

#include "cli/complaint.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"

namespace touchdown::cli {
namespace {

enum ExitCode : int { good = 0, failed = 1, wrong_request = 2 };

int complain(const std::string& message, ExitCode code) {
  fmt::print(stderr, "touchdown: {}\n", message);
  return code;
}

std::string joined(int argc, char** argv) {
  std::string line = "touchdown";
  for (int i = 1; i < argc; ++i) line += fmt::format(" {}", argv[i]);
  return line;
}

int run_command_line(int argc, char** argv) {
  CliSession session{joined(argc, argv), nullptr, {}};
  CLI::App program(
      "touchdown run experiments/stairs.yaml\n\n"
      "Simulates wheeled bipeds in two physics engines, injects sensor noise, and\n"
      "scores what contact estimators make of it.",
      "touchdown");
  program.set_version_flag("--version", "touchdown " TOUCHDOWN_VERSION);
  program.require_subcommand(1);
  program.failure_message(CLI::FailureMessage::simple);
  add_run(program, session);
  add_merge(program, session);
  add_simulate(program, session);
  add_render(program, session);
  add_report(program, session);
  add_train(program, session);
  add_fit(program, session);
  add_estimate(program, session);
  add_list(program, session);

  if (argc < 2) {
    fmt::print("{}", program.help());
    return wrong_request;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    return complain(complaint(program, argc, argv, error), wrong_request);
  }
  try {
    session.stop = &stop_on_interrupt();
    session.action();
    return good;
  } catch (const InputError& error) {
    return complain(error.what(), wrong_request);
  } catch (const std::exception& error) {
    return complain(error.what(), failed);
  }
}

}  // namespace
}  // namespace touchdown::cli

int main(int argc, char** argv) { return touchdown::cli::run_command_line(argc, argv); }
