#include "cli/show_result.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program/streams.hpp"
#include "experiments/results/manifest.hpp"
#include "experiments/results/terminal.hpp"
#include "render/report/pictures.hpp"
#include "render/report/report.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::cli {

namespace {

void draw(experiments::ExperimentResult& result, const CliSession& session, bool with_films) {
  std::vector<render::FilmedRun> filmed;
  if (result.experiment.video.enabled) {
    filmed = render::filmed_runs(render::read_subject(result.directory.path()));
  }
  render::draw_pictures(result, filmed, render::study_pictures(), with_films, session.stop);
  experiments::write_manifest(result);
  render::make_report(render::read_subject(result.directory.path()), filmed,
                      render::study_pictures(), {.film = with_films});
}

/// The last lines of output: a table of results, the paths of all outputs and the next commands.
std::string last_screen(const experiments::ExperimentResult& result, const CliSession& session) {
  const std::filesystem::path& directory = result.directory.path();
  std::string text =
      fmt::format("{}\nreport    {}\nfigures   {}\n", experiments::closing_text(result),
                  (directory / "report.html").string(), (directory / "figures").string());
  if (is_there(directory / "videos")) {
    text += fmt::format("videos    {}\n", (directory / "videos").string());
  }
  const char* next = result.experiment.name == "noise_study" ? "cross_simulator" : "noise_study";
  return text + fmt::format("\nnext      {0} run experiments/{1}.yaml\n          {0} list\n",
                            session.program, next);
}

}  // namespace

void add_picture_flags(Verb& verb, ShownPictures* pictures) {
  verb.flag("--no-pictures", &pictures->none, "Write tables only, without figures and videos");
  verb.flag("--no-video", &pictures->no_video,
            "Write tables, figures and the report, but no videos");
}

void show(experiments::ExperimentResult& result, const CliSession& session,
          const ShownPictures& pictures) {
  print(experiments::summary_text(result));
  print(fmt::format("\nresults   {}\ntables    {}\n", result.directory.path().string(),
                    (result.directory.path() / "tables").string()));
  flush_printed();
  if (!pictures.none) {
    draw(result, session, !pictures.no_video);
    print(last_screen(result, session));
  }
  if (!result.failed_demands.empty()) {
    throw Error(fmt::format("demanded verdicts fail: {}", fmt::join(result.failed_demands, ", ")));
  }
}

}  // namespace touchdown::cli
