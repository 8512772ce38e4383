#include <algorithm>
#include <memory>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/keys/kinds.hpp"
#include "cli/keys/reference.hpp"
#include "cli/verbs.hpp"
#include "core/program/streams.hpp"

namespace touchdown::cli {

namespace {

struct KeysFlags {
  std::string kind;
  bool markdown = false;
};

/// The width of the terminal, within what is readable; 100 if the output is a file or a pipe.
std::size_t terminal_columns() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 100;
  return std::clamp<std::size_t>(size.ws_col, 60, 120);
}

void print_keys(const KeysFlags& flags) {
  if (flags.markdown) {
    return print(flags.kind.empty() ? reference_document()
                                    : reference_markdown(file_kind(flags.kind)));
  }
  if (!flags.kind.empty()) return print(reference_text(file_kind(flags.kind), terminal_columns()));
  for (const FileKind& kind : file_kinds()) {
    if (&kind != &file_kinds().front()) print("\n\n");
    print(reference_text(kind, terminal_columns()));
  }
}

}  // namespace

void add_keys(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(program, "keys",
            "touchdown keys scenario\n\n"
            "Prints every key of the YAML files, with type, unit, range, default and meaning.\n"
            "Kinds of files: experiment, scenario, robot, sensors, mapping, training.");
  const auto flags = std::make_shared<KeysFlags>();
  verb.option("kind", &flags->kind, "Kind of file; all kinds if absent").value_name("KIND");
  verb.flag("--markdown", &flags->markdown,
            "Print the document docs/reference/keys.md, or its section");
  verb.action([flags] { print_keys(*flags); });
}

}  // namespace touchdown::cli
