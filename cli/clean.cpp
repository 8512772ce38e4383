#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "experiments/run_directory/old_runs.hpp"

namespace touchdown::cli {

namespace {

struct CleanFlags {
  std::string runs = "runs";
  bool dry_run = false;
};

void clean(const CleanFlags& flags) {
  std::uintmax_t bytes = 0;
  for (const experiments::OldRun& run : experiments::old_runs(flags.runs)) {
    if (!flags.dry_run) std::filesystem::remove_all(run.directory);
    bytes += run.bytes;
    fmt::print("{}  {:.1f} MB\n", run.directory.string(), 1e-6 * static_cast<double>(run.bytes));
  }
  fmt::print("{:.1f} MB {}\n", 1e-6 * static_cast<double>(bytes),
             flags.dry_run ? "would be free" : "are free");
}

}  // namespace

void add_clean(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(program, "clean",
            "touchdown clean --dry-run\n\n"
            "Removes all runs but the latest of each experiment.");
  const auto flags = std::make_shared<CleanFlags>();
  verb.option("runs", &flags->runs, "Folder of runs").value_name("DIR").shows_default();
  verb.flag("--dry-run", &flags->dry_run, "Only show what would go");
  verb.action([flags] { clean(*flags); });
}

}  // namespace touchdown::cli
