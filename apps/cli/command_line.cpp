#include "apps/cli/command_line.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <malloc.h>
#include <new>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/program.hpp"
#include "core/yaml.hpp"

namespace touchdown::cli {

namespace {

std::vector<std::string> verbs(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

/// A command of earlier versions, and what serves its need.
struct FormerVerb {
  std::string_view name;
  const char* successor;
};
constexpr std::array former_verbs = {
    FormerVerb{"merge", "touchdown run DIR"},
    FormerVerb{"figure", "touchdown report RUN --figure NAME"},
    FormerVerb{"export", "touchdown convert"},
    FormerVerb{"label", "touchdown estimate LOG --propose FILE.csv"},
    FormerVerb{"keys", "touchdown list KIND"},
    FormerVerb{"manual", "touchdown list commands --markdown"},
    FormerVerb{"clean", "rm -r runs/NAME/ID"}};

/// A one-line message about a wrong command line that suggests the nearest existing verb or flag.
std::string complaint(const CLI::App& program, int argc, char** argv,
                      const CLI::ParseError& error) {
  const std::vector<std::string> known = verbs(program);
  const std::string verb = argc > 1 ? argv[1] : "";
  if (std::find(known.begin(), known.end(), verb) == known.end()) {
    if (verb.starts_with('-')) return unknown_flag(verb, program);
    const auto* const former = std::ranges::find(former_verbs, verb, &FormerVerb::name);
    if (former != former_verbs.end()) {
      return fmt::format("'{}' is gone: use '{}'", verb, former->successor);
    }
    const std::string near = did_you_mean(verb, known);
    return fmt::format("unknown command '{}'{}", verb,
                       near.empty() ? fmt::format(" (known: {})", fmt::join(known, ", ")) : near);
  }
  return fmt::format("{}: {}", verb, refused_words(*program.get_subcommand(verb), error.what()));
}

/// "file: reason", without the name of the failed function.
std::string reason_of(const std::filesystem::filesystem_error& error) {
  return fmt::format("{}: {}", error.path1().string(), error.code().message());
}

int run_command_line(int argc, char** argv) {
  const CliSession session{command_text("touchdown", argc, argv), argc > 0 ? argv[0] : "touchdown",
                           &stop_on_interrupt()};
  CLI::App program(
      "touchdown run experiments/stairs.yaml\n\n"
      "Simulates wheeled bipeds in two physics engines, adds sensor noise and scores contact\n"
      "estimators.",
      "touchdown");
  program.set_version_flag("--version", "touchdown " TOUCHDOWN_VERSION);
  program.require_subcommand(1);
  program.failure_message(CLI::FailureMessage::simple);
  add_run(program, session);
  add_generate(program, session);
  add_simulate(program, session);
  add_render(program, session);
  add_report(program, session);
  add_compare(program, session);
  add_train(program, session);
  add_watch(program, session);
  add_fit(program, session);
  add_estimate(program, session);
  add_check(program, session);
  add_convert(program, session);
  add_score(program, session);
  add_list(program, session);

  if (argc < 2) {
    print("{}", program.help());
    return wrong_request;
  }
  try {
    program.parse(argc, argv);  // and runs the verb
    return good;
  } catch (const CLI::Success& asked) {  // --help, --version
    return print_answer(program, asked);
  } catch (const CLI::ParseError& error) {
    return complain(complaint(program, argc, argv, error), wrong_request);
  } catch (const InputError& error) {
    // To the reader of a stream that ends early, because it was asked to, the input looks cut off.
    // Of all commands, only an experiment may have saved something before it finds a wrong input.
    const bool saves_parts = argc > 1 && std::string_view(argv[1]) == "run";
    if (*session.stop) {
      return complain(saves_parts ? "stopped" : "stopped; nothing was written", failed);
    }
    return complain(with_option(*program.get_subcommands().front(), error.what()), wrong_request);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(reason_of(error), failed);
  } catch (const std::exception& error) {
    return complain(error.what(), failed);
  }
}

/// Keeps freed memory in the process. Runs allocate tens of megabytes each, and the system clears
/// returned pages one by one when they are needed again. Call it before any allocation.
void keep_freed_memory() noexcept {
  constexpr int gigabyte = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, gigabyte);
  ::mallopt(M_TRIM_THRESHOLD, gigabyte);
}

}  // namespace

int run_program(int argc, char** argv) {
  stop_on_interrupt();
  keep_freed_memory();
  open_standard_streams();
  return finished([&] { return run_command_line(argc, argv); });
}

}  // namespace touchdown::cli
