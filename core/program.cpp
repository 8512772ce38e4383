#include "core/program.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <malloc.h>
#include <new>
#include <optional>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/progress.hpp"
#include "core/terminal_text.hpp"
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
  const auto whole = std::ranges::find_if(
      flags, [&](const std::string& flag) { return flag.starts_with(beginning); });
  if (whole != flags.end() && beginning != "--") return *whole;
  if (is_letter) return "";
  std::string near = nearest(spelled, flags);
  if (!near.empty()) return near;
  const auto inner = std::ranges::find_if(
      flags, [&](const std::string& flag) { return spelled.starts_with(flag); });
  return inner == flags.end() ? "" : *inner;
}

namespace fs = std::filesystem;

using Identity = std::pair<dev_t, ino_t>;

/// Empty for what is no file: terminals and pipes may be input and output at the same time.
/// `standard` is the descriptor that "-" stands for.
std::optional<Identity> identity_of(const fs::path& path, int standard) {
  struct stat status = {};
  const bool found =
      path == "-" ? ::fstat(standard, &status) == 0 : ::stat(path.c_str(), &status) == 0;
  if (!found || !S_ISREG(status.st_mode)) return {};
  return Identity{status.st_dev, status.st_ino};
}

void check_against_input(const fs::path& output, const InputFile& input) {
  const std::optional<Identity> written = identity_of(output, STDOUT_FILENO);
  if (!written || written != identity_of(input.path, STDIN_FILENO)) return;
  const std::string name = output == "-" ? "standard output" : output.string();
  const std::string other = input.path == "-" ? "standard input" : input.path.string();
  throw InputError(fmt::format("{}: is the {} itself{}: name another file", name, input.what,
                               name == other ? "" : fmt::format(" ({})", other)));
}

bool is_one_file(const fs::path& a, const fs::path& b) {
  const std::optional<Identity> identity = identity_of(a, STDOUT_FILENO);
  if (identity) return identity == identity_of(b, STDOUT_FILENO);
  if (a == "-" || b == "-") return a == b;
  std::error_code ignored;
  return fs::weakly_canonical(absolute_path(a), ignored) ==
         fs::weakly_canonical(absolute_path(b), ignored);
}

// Signal handlers can access globals only.
std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int /*signal*/) { stop_requested = true; }

void complain_of_output(int reason) {
  complain(fmt::format("standard output cannot be written{}{}", reason == 0 ? "" : ": ",
                       reason == 0 ? "" : std::strerror(reason)),
           failed);
}

/// Reports the first error alone.
template <typename Write>
void write_output(const Write& write) {
  const bool was_writable = std::ferror(stdout) == 0;
  errno = 0;
  if (!write() && was_writable) complain_of_output(errno);
}

}  // namespace

void release_free_memory() noexcept {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

const std::atomic<bool>& stop_on_interrupt() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    ::sigaction(signal, nullptr, &before);
    // `nohup` lets programs ignore SIGHUP. Scripts let jobs in the background ignore SIGINT, which
    // has to stop these all the same.
    const bool is_unwanted = signal == SIGHUP && before.sa_handler == SIG_IGN;
    if (!is_unwanted) ::sigaction(signal, &action, nullptr);
  }
  ::signal(SIGXFSZ, SIG_IGN);
  return stop_requested;
}

void open_standard_streams() {
  // By descriptor; each is the lowest that is free when its turn comes.
  constexpr std::array<int, 3> modes = {O_WRONLY, O_RDONLY, O_WRONLY};
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    (void)::open("/dev/null", modes.at(static_cast<std::size_t>(stream)));  // NOLINT
  }
}

void print(std::string_view text) {
  const std::string shown = terminal_text(text, "\n\t");
  write_output([&] { return std::fwrite(shown.data(), 1, shown.size(), stdout) == shown.size(); });
}

void flush_printed() {
  write_output([] { return std::fflush(stdout) == 0; });
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    print_message(fmt::format("touchdown: {}\n", warning));
  }
}

int complain(const std::string& message, ExitCode code) {
  print_message(fmt::format("touchdown: {}\n", terminal_text(message)));
  return code;
}

int finished(const std::function<int()>& work) {
  int code = failed;
  try {
    code = work();
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory", failed);
  }
  const bool is_reported = std::cout.good() && std::ferror(stdout) != 0;  // by `print`
  errno = 0;
  std::cout.flush();
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::cout && std::ferror(stdout) == 0) return code;
  if (!is_reported) complain_of_output(errno);
  return code == good ? failed : code;
}

void check_outputs(const std::vector<InputFile>& inputs, const std::vector<fs::path>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const InputFile& input : inputs) check_against_input(outputs[i], input);
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_one_file(outputs[j], outputs[i])) continue;
      throw InputError(
          fmt::format("{}: would be written twice: name two files", outputs[i].string()));
    }
  }
  for (const fs::path& output : outputs) {
    if (output != "-") require_writable(output);
  }
}

void require_extension(const fs::path& output, const std::vector<std::string>& extensions,
                       const std::string& what) {
  const std::string extension = output.extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return;
  throw InputError(fmt::format("{}: expected {} with the extension {}", output.string(), what,
                               fmt::join(extensions, " or ")));
}

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
  if (!command.remaining(true).empty()) {
    return fmt::format("'{}': expected no further word", command.remaining(true).front());
  }
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

std::string with_option(const CLI::App& command, const std::string& message) {
  std::string named;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty() || !message.starts_with(value + ": ")) continue;
      if (option->get_positional()) return message;
      named = option->get_name() + ": ";
    }
  }
  return named + message;
}

std::string command_text(std::string_view program, int argc, char** argv) {
  std::string line(program);
  for (int i = 1; i < argc; ++i) line += fmt::format(" {}", argv[i]);
  for (std::size_t at = 0; (at += utf8_size(std::string_view(line).substr(at))) < line.size();) {
    line[at] = '?';
  }
  return line;
}

int run_command(CLI::App& program, int argc, char** argv, const std::function<int()>& work) {
  try {
    program.parse(argc, argv);
    return work();
  } catch (const CLI::Success& asked) {  // --help
    return print_answer(program, asked);
  } catch (const CLI::ParseError& error) {
    const std::string& name = program.get_name();
    return complain(fmt::format("{}: {}", name.substr(name.rfind(' ') + 1),
                                refused_words(program, error.what())),
                    wrong_request);
  } catch (const InputError& error) {
    return complain(with_option(program, error.what()), wrong_request);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return complain(error.what(), failed);
  }
}

}  // namespace touchdown
