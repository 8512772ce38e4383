#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "cli/keys/kinds.hpp"
#include "cli/manual/completion.hpp"
#include "cli/manual/markdown.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program/streams.hpp"
#include "experiments/estimators/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::cli {

namespace {

/// Adds the choices that verbs look up in registries only when they run.
void add_known_names(std::vector<DescribedVerb>& verbs) {
  std::vector<std::string> kinds;
  for (const FileKind& kind : file_kinds()) kinds.push_back(kind.name);
  const std::map<std::string, std::vector<std::string>> known = {
      {"kind", kinds},
      {"--simulator", simulators::simulator_names()},
      {"--estimator", experiments::estimator_names()}};
  for (DescribedVerb& verb : verbs) {
    for (DescribedOption& option : verb.options) {
      const auto names = known.find(option.names.back());
      if (names != known.end()) option.choices = names->second;
    }
  }
}

struct ManualFlags {
  std::string share;
  bool markdown = false;
};

void write_manual(const CLI::App& program, const ManualFlags& flags) {
  std::vector<DescribedVerb> verbs = described_verbs(program);
  if (flags.markdown) return print(markdown_manual(verbs));
  if (flags.share.empty()) throw InputError("manual: expected DIR or --markdown");
  const std::filesystem::path share = flags.share;
  add_known_names(verbs);
  write_atomically(share / "bash-completion" / "completions" / "touchdown", bash_completion(verbs));
  write_atomically(share / "zsh" / "site-functions" / "_touchdown", zsh_completion(verbs));
}

}  // namespace

void add_manual(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(
      program, "manual",
      "touchdown manual ~/.local/share\n\n"
      "Writes completion scripts for bash and zsh to where the shells look for them. An installed\n"
      "touchdown includes them.");
  const auto flags = std::make_shared<ManualFlags>();
  verb.option("share", &flags->share, "Folder for data, such as ~/.local/share").value_name("DIR");
  verb.flag("--markdown", &flags->markdown, "Print the document docs/reference/cli.md");
  verb.action([&program, flags] { write_manual(program, *flags); });
}

}  // namespace touchdown::cli
