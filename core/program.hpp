#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

// CLI11 takes seconds to compile wherever it is included.
namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's name
class App;
class Success;
}  // namespace CLI

namespace touchdown {

/// Installs signal handlers: the first Ctrl-C (or SIGTERM, or SIGHUP of a terminal that closes)
/// requests a stop, the second one kills. Under `nohup`, SIGHUP stays ignored. A write
/// beyond `ulimit -f` fails with an error in place of a signal. The returned flag becomes true on
/// the request. Call it first, because until then a signal kills.
const std::atomic<bool>& stop_on_interrupt();

/// Returns freed memory to the system all the same, after work that left much of it in pieces.
void release_free_memory() noexcept;

/// Exit code of a program.
enum ExitCode : int { good = 0, failed = 1, wrong_request = 2 };

/// Replaces closed standard streams: input is empty, messages are dropped, and results are refused.
/// Otherwise the next opened file would take their descriptor and receive their text. Call it
/// before any file is opened.
void open_standard_streams();

/// Prints on standard output, as `terminal_text` with line ends and tabs. A write error does not
/// stop the work: the first one is reported, and `finished` returns an error.
void print(std::string_view text);
/// The same for a format and its arguments.
template <typename First, typename... More>
void print(fmt::format_string<First, More...> format, First&& first, More&&... more) {
  print(std::string_view(
      fmt::format(format, std::forward<First>(first), std::forward<More>(more)...)));
}

/// Shows what was printed so far. It reports errors as `print` does.
void flush_printed();

/// Prints warnings on standard error, one line each.
void print_warnings(const std::vector<std::string>& warnings);

/// Prints an error message as one line on standard error and returns `code`.
int complain(const std::string& message, ExitCode code);

/// Runs a whole program and returns the exit code of `work`. Reports and returns an error if memory
/// ran out or standard output could not be written.
int finished(const std::function<int()>& work);

/// A file that a program reads; "-" is standard input.
struct InputFile {
  std::filesystem::path path;
  std::string what;  ///< "log", "model", "scenario"
};

/// Checks all outputs before the first one is opened. `outputs` are all files that will be written;
/// "-" is standard output. Files are compared by device and inode, so links and other spellings
/// count as the same file. Errors: `InputError` for
/// - an output that is one of the inputs;
/// - two outputs that are the same file;
/// - an existing output that is not a file, such as a device: writing atomically would replace it;
/// and `Error` for an output that cannot be written.
void check_outputs(const std::vector<InputFile>& inputs,
                   const std::vector<std::filesystem::path>& outputs);

/// Errors: `InputError` unless the output has one of the `extensions`, such as ".mpack". Readers
/// choose the format by the extension. `what` names the output: "a recording".
void require_extension(const std::filesystem::path& output,
                       const std::vector<std::string>& extensions, const std::string& what);

/// Prints what `--help` and `--version` ask for, and returns the exit code.
int print_answer(const CLI::App& program, const CLI::Success& asked);

/// The command line as text, after the program's name. A byte that is not valid UTF-8 becomes a
/// question mark, because manifests hold only UTF-8.
std::string command_text(std::string_view program, int argc, char** argv);

/// Runs a command with a program of its own: reads its words, then does `work`. Returns the exit
/// code. Reports refused words with the command's name, and errors of `work`.
int run_command(CLI::App& program, int argc, char** argv, const std::function<int()>& work);

/// "unknown flag '--otu' (did you mean '--out'?)". Without a near flag, it lists all flags of the
/// command. A value after "=" does not count. For a file of this name, it shows how to write it.
std::string unknown_flag(std::string_view word, const CLI::App& command);

/// One line about words that the command refused: its first unknown flag, or else `message`, which
/// is CLI11's own.
std::string refused_words(const CLI::App& command, std::string message);

/// "--prior: model.npz: no such file": a message about a whole file, with the option that named it.
std::string with_option(const CLI::App& command, const std::string& message);

}  // namespace touchdown
