#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/own_files.hpp"

namespace touchdown::cli {

namespace {

namespace fs = std::filesystem;

/// A run directory that is not its experiment's latest.
struct OldRun {
  fs::path directory;
  std::uintmax_t bytes = 0;  ///< of all files in it
};

/// Links are not followed.
fs::file_type type_of(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type();
}

std::uintmax_t size_of(const fs::path& directory) {
  std::uintmax_t bytes = 0;
  for (const fs::path& entry : entries_below(directory)) {
    if (type_of(entry) == fs::file_type::regular) bytes += size_of_file(entry);
  }
  return bytes;
}

void add_old_runs_of(const fs::path& experiment, std::vector<OldRun>& found) {
  std::error_code none;
  const fs::path latest = fs::canonical(experiment / "latest", none);
  if (none) return;
  for (const fs::path& entry : entries_in(experiment)) {
    const bool is_run = type_of(entry) == fs::file_type::directory &&
                        fs::is_regular_file(entry / "config.yaml", none);
    if (is_run && fs::canonical(entry, none) != latest) found.push_back({entry, size_of(entry)});
  }
}

/// The run directories `runs/<experiment>/<id>`, sorted by name, except those that `latest` points
/// to. Experiments without a `latest` and folders without a `config.yaml` are skipped.
/// Errors: `InputError` when `runs` is no directory.
std::vector<OldRun> old_runs(const fs::path& runs) {
  if (!is_folder(runs)) {
    throw InputError(fmt::format("{}: expected a folder of runs", runs.string()));
  }
  std::vector<OldRun> found;
  for (const fs::path& entry : entries_in(runs)) {
    if (type_of(entry) == fs::file_type::directory) add_old_runs_of(entry, found);
  }
  std::ranges::sort(found, {}, &OldRun::directory);
  return found;
}

struct CleanFlags {
  std::string runs = "runs";
  bool dry_run = false;
};

/// Removes a run, prints its size and returns the removed bytes. A run that is in use remains, and
/// so do untracked files.
std::uintmax_t remove(const OldRun& run, const CliSession& session) {
  experiments::UntrackedFiles left;
  try {
    const experiments::DirectoryLock lock(run.directory, experiments::Access::alone,
                                          session.command);
    left = experiments::remove_run(run.directory);
  } catch (const Error& error) {
    print("{}\n", error.what());
    return 0;
  }
  if (left.files > 0) {
    print("{}  {} untracked files remain\n", run.directory.string(), left.files);
  }
  return run.bytes - std::min(run.bytes, left.bytes);
}

void clean(const CleanFlags& flags, const CliSession& session) {
  std::uintmax_t all = 0;
  for (const OldRun& run : old_runs(flags.runs)) {
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
