#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/cli/file_kinds.hpp"
#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "experiments/estimators/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::cli {

namespace {

/// An option or positional argument as the program declares it.
struct DescribedOption {
  std::vector<std::string> names;    ///< "-o", "--output"; a positional argument has no dash
  std::string value;                 ///< "DIR"; empty for a flag
  int count = 0;                     ///< minimum number of values
  bool more = false;                 ///< whether more values may follow
  std::string text;                  ///< description on one line
  std::string fallback;              ///< default value; empty if the help does not show it
  std::vector<std::string> choices;  ///< possible values, if known
  bool positional = false;
  bool required = false;
};

/// The parts of a verb's `--help` text.
struct DescribedVerb {
  std::string name;                   ///< "run"
  std::vector<std::string> examples;  ///< complete command lines
  std::string text;                   ///< description on one line
  std::vector<DescribedOption> options;
};

/// "a" and "b" of "TEXT:{a,b}", which is CLI11's name of a type with choices.
std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t begin = type.find(":{");
  if (begin == std::string::npos) return choices;
  std::istringstream listed(type.substr(begin + 2, type.find('}') - begin - 2));
  for (std::string choice; std::getline(listed, choice, ',');) choices.push_back(choice);
  return choices;
}

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

/// The program's verbs in the order of its help.
std::vector<DescribedVerb> described_verbs(const CLI::App& program) {
  std::vector<DescribedVerb> verbs;
  for (const CLI::App* verb : program.get_subcommands({})) verbs.push_back(described(*verb));
  return verbs;
}

/// Text for a cell of a table, without `special` characters of Markdown: a bar ends a cell, and `<`
/// begins HTML outside of code.
std::string cell(const std::string& text, std::string_view special) {
  std::string result;
  for (const char letter : text) {
    if (special.find(letter) != std::string_view::npos) result += '\\';
    result += letter;
  }
  return result;
}

std::string names_of(const DescribedOption& option) {
  std::string names = fmt::format("{}", fmt::join(option.names, ", "));
  if (!option.positional) {
    for (int i = 0; i < option.count; ++i) names += " " + option.value;
  }
  return option.more ? names + " ..." : names;
}

std::string row(const DescribedOption& option) {
  std::string text = option.text;
  if (option.required) text += " (required)";
  if (!option.fallback.empty()) text += fmt::format(" (default: {})", option.fallback);
  return fmt::format("| `{}` | {} |\n", cell(names_of(option), "|"), cell(text, "|<"));
}

std::string section(const DescribedVerb& verb) {
  std::string text = fmt::format("\n## {}\n\n{}\n\n```\n{}\n```\n", verb.name, verb.text,
                                 fmt::join(verb.examples, "\n"));
  if (!verb.options.empty()) text += "\n| option | meaning |\n|---|---|\n";
  for (const DescribedOption& option : verb.options) {
    if (option.names.back() != "--help") text += row(option);  // of every command
  }
  return text;
}

/// The document docs/reference/cli.md: every command with its examples and options.
std::string markdown_manual(const std::vector<DescribedVerb>& verbs) {
  std::string text =
      "# Commands\n\n"
      "Generated by `touchdown manual --markdown > docs/reference/cli.md`. `touchdown COMMAND "
      "--help` prints one of them, an installed program has man pages. Exit codes: 0 success, 1 a "
      "failed run, 2 a wrong request.\n";
  for (const DescribedVerb& verb : verbs) text += section(verb);
  return text;
}

/// The text for zsh's single quotes. Brackets and colons are escaped, because `_arguments` parses
/// them.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\'') {
      result += "'\\''";
      continue;
    }
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') result += '\\';
    result += letter;
  }
  return result;
}

/// One option as a line for `_arguments`: '(-o --output)'{-o,--output=}'[text]:FILE:_files'.
std::string argument(const DescribedOption& option) {
  std::vector<std::string> forms;
  for (const std::string& name : option.names) {
    forms.push_back(option.count > 0 && name.starts_with("--") ? name + "=" : name);
  }
  std::string names = forms.front();
  if (forms.size() > 1) {
    names = fmt::format("'{{{}}}'", fmt::join(forms, ","));
    if (!option.more) names = fmt::format("({}){}", fmt::join(option.names, " "), names);
  }
  const std::string values =
      option.choices.empty() ? "_files" : fmt::format("({})", fmt::join(option.choices, " "));
  std::string actions;
  for (int i = 0; i < option.count; ++i) {
    actions += fmt::format(":{}:{}", quoted(option.value), values);
  }
  return fmt::format("        '{}{}[{}]{}' \\\n", option.more ? "*" : "", names,
                     quoted(option.text), actions);
}

/// Completion scripts for verbs, options and values with known choices. All other values complete
/// to file names.
std::string bash_completion(const std::vector<DescribedVerb>& verbs) {
  std::vector<std::string> names;
  std::string options;
  std::string values;
  for (const DescribedVerb& verb : verbs) {
    names.push_back(verb.name);
    std::vector<std::string> dashed;
    for (const DescribedOption& option : verb.options) {
      if (!option.positional) {
        dashed.insert(dashed.end(), option.names.begin(), option.names.end());
      }
      if (option.choices.empty()) continue;
      values += fmt::format("    '{} {}') words=\"{}\" ;;\n", verb.name,
                            option.positional ? verb.name : option.names.back(),
                            fmt::join(option.choices, " "));
    }
    options += fmt::format("    {}) words=\"{}\" ;;\n", verb.name, fmt::join(dashed, " "));
  }
  return fmt::format(R"(# bash completion for touchdown, generated from its options
_touchdown() {{
  local verb="${{COMP_WORDS[1]}}" words=""
  local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD - 1]}}"
  COMPREPLY=()
  # bash splits --name=value into three words
  [[ "$before" == "=" ]] && before="${{COMP_WORDS[COMP_CWORD - 2]}}"
  [[ "$word" == "=" ]] && word=""
  if ((COMP_CWORD == 1)); then
    words="{} --help --version"
  else
    case "$verb $before" in
{}    esac
  fi
  if [[ -z "$words" && "$word" == -* ]]; then
    case "$verb" in
{}    esac
  fi
  [[ -n "$words" ]] && mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  return 0
}}
complete -o default -F _touchdown touchdown
)",
                     fmt::join(names, " "), values, options);
}

std::string zsh_completion(const std::vector<DescribedVerb>& verbs) {
  std::string names;
  std::string cases;
  for (const DescribedVerb& verb : verbs) {
    names += fmt::format("    '{}:{}'\n", verb.name, quoted(verb.text));
    cases += fmt::format("    {})\n      _arguments \\\n", verb.name);
    for (const DescribedOption& option : verb.options) {
      if (!option.positional) cases += argument(option);
      if (option.positional && !option.choices.empty()) {
        cases +=
            fmt::format("        '1:{}:({})' \\\n", option.value, fmt::join(option.choices, " "));
      }
    }
    cases += "        '*:file:_files'\n      ;;\n";
  }
  return fmt::format(R"(#compdef touchdown
# zsh completion for touchdown, generated from its options
_touchdown() {{
  local -a verbs
  verbs=(
{}  )
  if ((CURRENT == 2)); then
    _describe -t verbs 'command' verbs
    return
  fi
  local verb="$words[2]"
  shift words
  ((CURRENT--))
  case "$verb" in
{}  esac
}}
_touchdown "$@"
)",
                     names, cases);
}

/// Adds the choices that verbs look up in registries only when they run.
void add_known_names(std::vector<DescribedVerb>& verbs) {
  std::vector<std::string> kinds;
  for (const FileKind& kind : file_kinds()) kinds.push_back(kind.name);
  const std::map<std::string, std::vector<std::string>> known = {
      {"kind", kinds},
      {"--simulator", simulators::simulator_names()},
      {"--estimator", experiments::estimator_names()}};
  for (DescribedVerb& verb : verbs) {
    for (DescribedOption& option : verb.options) {
      const auto names = known.find(option.names.back());
      if (names != known.end()) option.choices = names->second;
    }
  }
}

struct ManualFlags {
  std::string share;
  bool markdown = false;
};

void write_manual(const CLI::App& program, const ManualFlags& flags) {
  std::vector<DescribedVerb> verbs = described_verbs(program);
  if (flags.markdown) return print(markdown_manual(verbs));
  if (flags.share.empty()) throw InputError("manual: expected DIR or --markdown");
  const std::filesystem::path share = flags.share;
  add_known_names(verbs);
  write_atomically(share / "bash-completion" / "completions" / "touchdown", bash_completion(verbs));
  write_atomically(share / "zsh" / "site-functions" / "_touchdown", zsh_completion(verbs));
}

}  // namespace

void add_manual(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(
      program, "manual",
      "touchdown manual ~/.local/share\n\n"
      "Writes completion scripts for bash and zsh to where the shells look for them. An installed\n"
      "touchdown includes them.");
  const auto flags = std::make_shared<ManualFlags>();
  verb.option("share", &flags->share, "Folder for data, such as ~/.local/share").value_name("DIR");
  verb.flag("--markdown", &flags->markdown, "Print the document docs/reference/cli.md");
  verb.action([&program, flags] { write_manual(program, *flags); });
}

}  // namespace touchdown::cli
