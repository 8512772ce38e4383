// `touchdown`: starts the program `touchdown-main` beside it with interrupts delayed. Hundreds of
// shared libraries are loaded before the first line of that program. Until its handler is
// installed, a signal would kill it without a word. This file needs the C library only, so that
// its own start takes a millisecond.

#include <csignal>
#include <cstdio>
#include <cstring>
#include <unistd.h>

#include "core/program/stop_signals.hpp"

namespace {

constexpr char program_name[] = "touchdown-main";

/// Writes the path of the program beside this one. Errors: false if it has no room or no place.
template <std::size_t size>
bool find_program(char (&path)[size]) {
  const ssize_t length = ::readlink("/proc/self/exe", path, size - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  char* const slash = std::strrchr(path, '/');
  if (slash == nullptr || slash + 1 + sizeof(program_name) > path + size) return false;
  std::memcpy(slash + 1, program_name, sizeof(program_name));
  return true;
}

}  // namespace

int main(int /*argc*/, char** argv) {
  touchdown::mask_stop_signals(SIG_BLOCK);
  char path[4096] = "";
  if (find_program(path)) ::execv(path, argv);
  std::fprintf(stderr, "touchdown: %s: cannot be started: is the installation complete?\n",
               path[0] == '\0' ? program_name : path);
  return 1;
}
