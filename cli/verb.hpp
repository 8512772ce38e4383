#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

// CLI11 takes seconds to compile wherever it is used; verbs declare themselves without seeing it.
namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's name
class App;
class Option;
}  // namespace CLI

namespace touchdown::cli {

/// Where the value of an option goes. What stands there before is its default.
using OptionValue =
    std::variant<int*, std::int64_t*, std::uint64_t*, double*, std::string*, std::vector<int>*,
                 std::vector<double>*, std::vector<std::string>*>;

/// One option of a verb while it is declared. Each function says one more thing about it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& value_name(const std::string& name);  ///< in the help: "DIR"
  Option& shows_default();
  Option& one_of(const std::vector<std::string>& values);
  Option& not_negative();
  Option& between(int lowest, int highest);
  Option& takes(int least, int most);  ///< so many values
  Option& takes(int count) { return takes(count, count); }
  Option& one_at_a_time();  ///< takes several values, but is typed again for each

 private:
  CLI::Option* option_;
};

/// One verb of the program, to be declared. The program keeps it; this is a handle.
class Verb {
 public:
  /// `help` is example command lines, an empty line, and what the verb does.
  Verb(CLI::App& program, const std::string& name, const std::string& help);

  /// `names` as in "-o,--output"; without a dash the option is a positional argument. The value
  /// must outlive the verb, here and in `flag`.
  Option option(const std::string& names, OptionValue value, const std::string& help);
  /// An option without a value: true if it is given.
  void flag(const std::string& names, bool* given, const std::string& help);

  /// What the verb does at the end of parsing.
  void action(std::function<void()> action);
  /// The same with all words behind the verb as they are, even `--help`: it has no options.
  void action_on_words(std::function<void(const std::vector<std::string>& words)> action);

 private:
  CLI::App* app_;
};

}  // namespace touchdown::cli
