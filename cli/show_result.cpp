#include "cli/show_result.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/tables/manifest.hpp"
#include "experiments/tables/result_files.hpp"
#include "render/pictures/filmed_report.hpp"
#include "render/pictures/pictures.hpp"

namespace touchdown::cli {

namespace {

void show_pictures(experiments::ExperimentResult& result, const CliSession& session) {
  std::vector<render::FilmedRun> filmed;
  if (result.experiment.video.enabled) {
    filmed = render::filmed_runs(render::read_subject(result.directory.path()));
  }
  for (const render::Picture& picture : render::draw_pictures(result, filmed, session.stop)) {
    std::string kind = picture.kind;
    for (const auto& file : picture.files) {
      fmt::print("{:<9} {}\n", kind, file.string());
      kind.clear();
    }
  }
  experiments::write_manifest(result);
  const auto report =
      render::make_report(render::read_subject(result.directory.path()), filmed, session.stop);
  fmt::print("{:<9} {}\n", "report", report.string());
}

}  // namespace

void show(experiments::ExperimentResult& result, const CliSession& session, bool no_pictures) {
  fmt::print("{}", experiments::summary_text(result));
  fmt::print("\nresults   {}\ntables    {}\n", result.directory.path().string(),
             (result.directory.path() / "tables").string());
  std::fflush(stdout);
  if (!no_pictures) show_pictures(result, session);
  if (!result.failed_demands.empty()) {
    throw Error(fmt::format("demanded verdicts fail: {}", fmt::join(result.failed_demands, ", ")));
  }
}

}  // namespace touchdown::cli
