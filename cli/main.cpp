#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/yaml.hpp"

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

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = did_you_mean(word, known);
  return near.empty() ? fmt::format(" (known: {})", fmt::join(known, ", ")) : near;
}

std::vector<std::string> verbs(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> flags(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string first_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// One line about what is wrong with a command line, with the nearest verb or flag that exists.
std::string complaint(const CLI::App& program, int argc, char** argv,
                      const CLI::ParseError& error) {
  const std::vector<std::string> known = verbs(program);
  const std::string verb = argc > 1 ? argv[1] : "";
  if (std::find(known.begin(), known.end(), verb) == known.end()) {
    if (verb.rfind('-', 0) == 0) {
      return fmt::format("unknown flag '{}'{}", verb, suggestion(verb, flags(program)));
    }
    return fmt::format("unknown command '{}'{}", verb, suggestion(verb, known));
  }
  const CLI::App* asked = program.get_subcommand(verb);
  for (const std::string& rest : asked->remaining(true)) {
    if (rest.rfind('-', 0) != 0) continue;
    const std::string flag = rest.substr(0, rest.find('='));
    return fmt::format("{}: unknown flag '{}'{}", verb, flag, suggestion(flag, flags(*asked)));
  }
  return fmt::format("{}: {}", verb, first_line(error.what()));
}

int run_command_line(int argc, char** argv) {
  const CliSession session{joined(argc, argv), &stop_on_interrupt()};
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
  add_clean(program, session);
  add_list(program, session);
  add_manual(program, session);

  if (argc < 2) {
    fmt::print("{}", program.help());
    return wrong_request;
  }
  try {
    program.parse(argc, argv);  // and does what the verb is for
    return good;
  } catch (const CLI::Success& asked) {  // --help, --version
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    return complain(complaint(program, argc, argv, error), wrong_request);
  } catch (const InputError& error) {
    return complain(error.what(), wrong_request);
  } catch (const std::exception& error) {
    return complain(error.what(), failed);
  }
}

}  // namespace
}  // namespace touchdown::cli

int main(int argc, char** argv) { return touchdown::cli::run_command_line(argc, argv); }
