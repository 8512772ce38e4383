#include "cli/complaint.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/yaml.hpp"

namespace touchdown::cli {

namespace {

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  return near.empty() ? fmt::format(" (known: {})", fmt::join(known, ", "))
                      : fmt::format(" (did you mean '{}'?)", near);
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

}  // namespace

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

}  // namespace touchdown::cli
