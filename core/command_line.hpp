#pragma once

#include <string>
#include <string_view>

// CLI11 takes seconds to compile wherever it is included.
namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's name
class App;
class Success;
}  // namespace CLI

namespace touchdown {

/// Prints what `--help` and `--version` ask for, and returns the exit code.
int print_answer(const CLI::App& program, const CLI::Success& asked);

/// "unknown flag '--otu' (did you mean '--out'?)". Without a near flag, it lists all flags of the
/// command. A value after "=" does not count. For a file of this name, it shows how to write it.
std::string unknown_flag(std::string_view word, const CLI::App& command);

/// One line about words that the command refused: its first unknown flag, or else `message`, which
/// is CLI11's own.
std::string refused_words(const CLI::App& command, std::string message);

}  // namespace touchdown
