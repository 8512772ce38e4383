#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/verb.hpp"
#include "core/error.hpp"
#include "core/program.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/old_runs.hpp"
#include "experiments/run_directory/own_files.hpp"

namespace touchdown::cli {

namespace {

struct CleanFlags {
  std::string runs = "runs";
  bool dry_run = false;
};

/// Removes a run, prints its size and returns the removed bytes. A run that is in use remains, and
/// so do untracked files.
std::uintmax_t remove(const experiments::OldRun& run, const CliSession& session) {
  std::optional<experiments::DirectoryLock> lock;
  try {
    lock.emplace(run.directory, experiments::Access::alone, session.command);
  } catch (const Error& error) {
    print("{}\n", error.what());
    return 0;
  }
  const experiments::UntrackedFiles left = experiments::remove_run(run.directory);
  if (left.files > 0) {
    print("{}  {} untracked files remain\n", run.directory.string(), left.files);
  }
  return run.bytes - std::min(run.bytes, left.bytes);
}

void clean(const CleanFlags& flags, const CliSession& session) {
  std::uintmax_t all = 0;
  for (const experiments::OldRun& run : experiments::old_runs(flags.runs)) {
    const std::uintmax_t bytes = flags.dry_run ? run.bytes : remove(run, session);
    if (bytes > 0) {
      print("{}  {:.1f} MB\n", run.directory.string(), 1e-6 * static_cast<double>(bytes));
    }
    all += bytes;
  }
  print("{:.1f} MB {}\n", 1e-6 * static_cast<double>(all),
        flags.dry_run ? "would be free" : "are free");
}

}  // namespace

void add_clean(CLI::App& program, const CliSession& session) {
  Verb verb(program, "clean",
            "touchdown clean --dry-run\n\n"
            "Removes all runs except the latest of each experiment.");
  const auto flags = std::make_shared<CleanFlags>();
  verb.option("runs", &flags->runs, "Folder of the runs").value_name("DIR").shows_default();
  verb.flag("--dry-run", &flags->dry_run, "Only show what would be removed");
  verb.action([flags, &session] { clean(*flags, session); });
}

}  // namespace touchdown::cli
