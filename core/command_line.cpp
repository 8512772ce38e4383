#include "core/command_line.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/program.hpp"
#include "core/yaml.hpp"

namespace touchdown {

namespace {

/// The names of a command's flags, the long name of each flag first.
std::vector<std::string> flags_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// As flags are written: in lower case, with "-" for "_".
std::string spelled_as_flag(std::string_view word) {
  std::string spelled(word);
  for (char& letter : spelled) {
    letter =
        letter == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return spelled;
}

/// The long flag that was meant, or nothing: one that begins with the word, else the nearest one,
/// else one that the word begins with. A single letter is near to flags that begin with it.
std::string nearest_flag(std::string_view word, std::vector<std::string> flags) {
  std::erase_if(flags, [](const std::string& flag) { return !flag.starts_with("--"); });
  const std::string spelled = spelled_as_flag(word);
  const bool is_letter = spelled.size() == 2;
  const std::string beginning = is_letter ? "-" + spelled : spelled;
  const auto whole = std::find_if(flags.begin(), flags.end(), [&](const std::string& flag) {
    return flag.starts_with(beginning);
  });
  if (whole != flags.end() && beginning != "--") return *whole;
  if (is_letter) return "";
  std::string near = nearest(spelled, flags);
  if (!near.empty()) return near;
  const auto inner = std::find_if(flags.begin(), flags.end(), [&](const std::string& flag) {
    return spelled.starts_with(flag);
  });
  return inner == flags.end() ? "" : *inner;
}

}  // namespace

int print_answer(const CLI::App& program, const CLI::Success& asked) {
  std::ostringstream text;
  const int code = program.exit(asked, text, text);
  print(text.str());
  return code;
}

std::string unknown_flag(std::string_view word, const CLI::App& command) {
  const std::string_view flag = word.substr(0, word.find('='));
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored)) {
    return fmt::format("unknown flag '{0}': write ./{0} for the file of that name", word);
  }
  const std::vector<std::string> flags = flags_of(command);
  const std::string near = nearest_flag(flag, flags);
  return fmt::format("unknown flag '{}' ({})", flag,
                     near.empty() ? fmt::format("known: {}", fmt::join(flags, ", "))
                                  : fmt::format("did you mean '{}'?", near));
}

std::string refused_words(const CLI::App& command, std::string message) {
  for (const std::string& word : command.remaining(true)) {
    if (word.starts_with('-')) return unknown_flag(word, command);
  }
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

}  // namespace touchdown
