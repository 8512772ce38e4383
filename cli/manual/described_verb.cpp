#include "cli/manual/described_verb.hpp"

#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>

namespace touchdown::cli {

namespace {

/// "a" and "b" of "TEXT:{a,b}", which is CLI11's name of a type with choices.
std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t begin = type.find(":{");
  if (begin == std::string::npos) return choices;
  std::istringstream listed(type.substr(begin + 2, type.find('}') - begin - 2));
  for (std::string choice; std::getline(listed, choice, ',');) choices.push_back(choice);
  return choices;
}

/// Replaces line ends by blanks.
std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

DescribedOption described_option(const CLI::Option& option) {
  DescribedOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  result.positional = result.names.empty();
  if (result.positional) result.names.push_back(option.get_name());
  result.text = on_one_line(option.get_description());
  result.required = option.get_required();
  if (option.get_type_size() == 0) return result;  // a flag
  const std::string type = option.get_type_name();
  result.value = type.substr(0, type.find(':'));
  result.choices = choices_in(type);
  result.fallback = option.get_default_str();
  result.count = option.get_expected_min();
  result.more = option.get_expected_max() > option.get_expected_min();
  return result;
}

DescribedVerb described(const CLI::App& app) {
  DescribedVerb result;
  result.name = app.get_name();
  std::istringstream description(app.get_description());
  for (std::string line; std::getline(description, line) && !line.empty();) {
    result.examples.push_back(line);
  }
  for (std::string line; std::getline(description, line);) {
    result.text += (result.text.empty() ? "" : " ") + line;
  }
  for (const CLI::Option* option : app.get_options())
    result.options.push_back(described_option(*option));
  return result;
}

}  // namespace

std::vector<DescribedVerb> described_verbs(const CLI::App& program) {
  std::vector<DescribedVerb> verbs;
  for (const CLI::App* verb : program.get_subcommands({})) verbs.push_back(described(*verb));
  return verbs;
}

}  // namespace touchdown::cli
