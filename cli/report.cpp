#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "core/files.hpp"
#include "core/program/streams.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/owner.hpp"
#include "render/pictures/filmed_report.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::cli {

namespace {

struct ReportFlags {
  std::string directory;
  bool no_film = false;
};

}  // namespace

void add_report(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "report",
      "touchdown report runs/stairs/latest\n\n"
      "Writes report.html into an experiment's run directory and replaces an existing one. The\n"
      "report is one page that opens without a network connection.");
  const auto flags = std::make_shared<ReportFlags>();
  verb.option("directory", &flags->directory, "Run directory").required();
  verb.flag("--no-film", &flags->no_film, "Leave out the video");
  verb.action([flags, &session] {
    experiments::require_no_links(flags->directory);
    std::optional<experiments::DirectoryLock> lock;
    if (experiments::owner_of(flags->directory)) {
      lock.emplace(flags->directory, experiments::Access::alone, session.command);
    }
    const render::ReportSubject subject = render::read_subject(flags->directory);
    std::vector<render::FilmedRun> filmed;
    if (!flags->no_film && subject.experiment.video.enabled) filmed = render::filmed_runs(subject);
    const std::filesystem::path path =
        render::make_report(subject, filmed, render::study_pictures(), session.stop);
    print("report    {} ({:.1f} MB)\n", path.string(),
          static_cast<double>(size_of_file(path)) / 1e6);
  });
}

}  // namespace touchdown::cli
