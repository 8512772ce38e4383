#include "core/program.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <new>
#include <unistd.h>

#include <fmt/format.h>

#include "core/progress.hpp"
#include "core/terminal_text.hpp"

namespace touchdown {

namespace {

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

}  // namespace touchdown
