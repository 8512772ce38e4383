#include "cli/manual/completion.hpp"

#include <fmt/format.h>

namespace touchdown::cli {

namespace {

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

}  // namespace

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

}  // namespace touchdown::cli
