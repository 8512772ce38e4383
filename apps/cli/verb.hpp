#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

// CLI11 takes seconds to compile wherever it is included, so verbs are declared without its
// headers.
namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's name
class App;
class Option;
}  // namespace CLI

namespace touchdown::cli {

/// The variable that receives an option's value. Its initial value is the default.
using OptionValue =
    std::variant<int*, std::int64_t*, std::uint64_t*, double*, std::string*, std::vector<int>*,
                 std::vector<double>*, std::vector<std::string>*>;

/// One option of a verb during its declaration. Each function sets one property.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& value_name(const std::string& name);  ///< the value's name in the help: "DIR"
  Option& shows_default();
  Option& one_of(const std::vector<std::string>& values);
  Option& between(double lowest, double highest);
  Option& takes(int least, int most);  ///< the number of values
  Option& takes(int count) { return takes(count, count); }
  Option& one_at_a_time();  ///< several values, each with the option's name before it

 private:
  CLI::Option* option_;
};

/// Declares one verb of the program. The program owns the verb; this is a handle.
class Verb {
 public:
  /// `help` consists of example command lines, an empty line and a description of the verb.
  Verb(CLI::App& program, const std::string& name, const std::string& help);

  /// `names` as in "-o,--output". Without a dash the option is a positional argument. `value` must
  /// outlive the verb.
  Option option(const std::string& names, OptionValue value, const std::string& help);
  /// An option without a value. It sets `*given`, which must outlive the verb, to true.
  void flag(const std::string& names, bool* given, const std::string& help);

  /// Sets the function that runs the verb at the end of parsing.
  void action(std::function<void()> action);
  /// The same for a verb without options: `action` receives all words after the verb, even
  /// `--help`.
  void action_on_words(std::function<void(const std::vector<std::string>& words)> action);

 private:
  CLI::App* app_;
};

/// The state that all verbs share.
struct CliSession {
  std::string command;                      ///< the command line
  std::string program;                      ///< the first word of the command line
  const std::atomic<bool>* stop = nullptr;  ///< becomes true on Ctrl-C
};

/// Each function adds one verb and its flags to the program. The verb runs at the end of parsing.
void add_run(CLI::App& program, const CliSession& session);
void add_generate(CLI::App& program, const CliSession& session);
void add_simulate(CLI::App& program, const CliSession& session);
void add_render(CLI::App& program, const CliSession& session);
void add_report(CLI::App& program, const CliSession& session);
void add_compare(CLI::App& program, const CliSession& session);
void add_train(CLI::App& program, const CliSession& session);
void add_watch(CLI::App& program, const CliSession& session);
void add_fit(CLI::App& program, const CliSession& session);
void add_estimate(CLI::App& program, const CliSession& session);
void add_check(CLI::App& program, const CliSession& session);
void add_convert(CLI::App& program, const CliSession& session);
void add_score(CLI::App& program, const CliSession& session);
void add_list(CLI::App& program, const CliSession& session);

}  // namespace touchdown::cli
