#include "render/report/report.hpp"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::cli {

namespace {

struct ReportFlags {
  std::string directory;
  bool no_video = false;
  bool no_replay = false;
};

}  // namespace

void add_report(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "report",
      "touchdown report runs/stairs/latest\n\n"
      "Writes report.html into an experiment's run directory and replaces an existing one. The\n"
      "report is one page that opens without a network connection. Its film is made if the run\n"
      "directory has none.");
  const auto flags = std::make_shared<ReportFlags>();
  verb.option("directory", &flags->directory, "Run directory").required();
  verb.flag("--no-video", &flags->no_video, "Leave out the video");
  verb.flag("--no-replay", &flags->no_replay, "Leave out the replay");
  verb.action([flags, &session] {
    experiments::require_no_links(flags->directory);
    std::optional<experiments::DirectoryLock> lock;
    if (experiments::owner_of(flags->directory)) {
      lock.emplace(flags->directory, experiments::Access::alone, session.command);
    }
    const render::ReportSubject subject = render::read_subject(flags->directory);
    for (const std::string& name : subject.edited_tables) {
      print_warnings(
          {fmt::format("{}/tables/{}: was edited since the run wrote it: the report shows "
                       "it as it is now, `touchdown run` writes it anew",
                       flags->directory, name)});
    }
    std::vector<render::FilmedRun> filmed;
    if (subject.experiment.video.enabled && !(flags->no_video && flags->no_replay)) {
      filmed = render::filmed_runs(subject);
    }
    if (!flags->no_video) {
      render::film_for_report(filmed, subject.experiment, flags->directory, session.stop);
    }
    const std::filesystem::path path =
        render::make_report(subject, filmed, render::study_pictures(),
                            {.film = !flags->no_video, .replay = !flags->no_replay});
    print("report    {} ({:.1f} MB)\n", path.string(),
          static_cast<double>(size_of_file(path)) / 1e6);
  });
}

}  // namespace touchdown::cli
