#include "cli/report.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "cli/film_progress.hpp"
#include "cli/filmed_run.hpp"
#include "core/error.hpp"
#include "render/frame_painter.hpp"
#include "render/report.hpp"

namespace touchdown {

namespace {

namespace fs = std::filesystem;

/// Longer runs are shown from their beginning only: the film lies inside the page (s).
constexpr double longest_film = 20.0;

ReportFlights flights_of(const FilmedRun& run, double end) {
  ReportFlights result{engine_label(run.recording), {}};
  LabelConfig visible = run.labels;
  visible.debounce = std::max(visible.debounce, 0.05);
  for (const Flight& flight : flights(any_wheel(contact_labels(run.recording, visible)))) {
    const double period = run.recording.period();
    const ReportFlights::Span span{static_cast<double>(flight.takeoff) * period,
                                   static_cast<double>(flight.landing) * period};
    if (span.takeoff > 0.0 && span.landing <= end) result.flights.push_back(span);
  }
  return result;
}

ReportFilm film(const std::vector<FilmedRun>& runs, const fs::path& directory,
                const Session& session) {
  ReportFilm result;
  result.video = directory / "videos" / "report.mp4";
  result.poster = directory / "videos" / "report.jpg";
  VideoOptions options;
  options.width = 960;
  options.height = 540;
  options.crf = 28;
  options.labels = runs.front().labels;
  double end = 0.0;
  std::string engines;
  for (const FilmedRun& run : runs) {
    end = std::max(end, static_cast<double>(run.recording.steps()) * run.recording.period());
    engines += (engines.empty() ? "" : " and ") + engine_label(run.recording);
  }
  options.to = std::min(end, longest_film);
  for (const FilmedRun& run : runs) result.engines.push_back(flights_of(run, options.to));
  result.description = fmt::format(
      "The {} run in {}{}{}. Below: what the estimators believe, over the true contact (green: "
      "dark "
      "where both wheels touch, light where one does), and torques; thick lines are the left "
      "wheel.",
      runs.front().recording.info.scenario, engines, runs.size() > 1 ? ", beside each other" : "",
      end > longest_film ? fmt::format(", its first {:.0f} seconds", longest_film) : "");
  options.progress = FilmProgress("filming for the report", session);
  if (runs.size() > 1) {
    render_side_by_side(runs[0].source(), runs[1].source(), options, result.video);
  } else {
    const FilmedRun& run = runs.front();
    render_video(run.robot, run.recording, run.beliefs, options, result.video);
  }
  std::vector<VideoSource> sources;
  for (std::size_t i = 0; i < std::min<std::size_t>(runs.size(), 2); ++i) {
    sources.push_back(runs[i].source());
  }
  render_poster(sources, options, NAN, result.poster);
  std::error_code ignored;
  for (const FilmedRun& run : runs) {
    const fs::path full =
        fs::path("videos") /
        fmt::format("{}_{}.mp4", run.recording.info.simulator, run.recording.info.scenario);
    if (fs::exists(directory / full, ignored)) result.full_size.push_back(full);
  }
  return result;
}

struct ReportFlags {
  std::string directory;
  bool no_film = false;
};

}  // namespace

fs::path make_report(const fs::path& run_directory, bool with_film, const Session& session) {
  std::vector<ReportFilm> films;
  if (with_film && fs::exists(run_directory / "config.yaml")) {
    const Experiment experiment =
        experiment_from_yaml(YamlDocument::load(run_directory / "config.yaml"));
    if (experiment.video.enabled) {
      const std::vector<FilmedRun> runs = filmed_runs(run_directory);
      if (!runs.empty()) films.push_back(film(runs, run_directory, session));
    }
  }
  return write_report(run_directory, films);
}

void add_report(CLI::App& program, Session& session) {
  CLI::App* verb = program.add_subcommand(
      "report",
      "touchdown report runs/stairs/latest\n\n"
      "Writes report.html into an experiment's run directory, again if it is there: one page that\n"
      "opens without a network.");
  const auto flags = std::make_shared<ReportFlags>();
  verb->add_option("directory", flags->directory, "Run directory")->required();
  verb->add_flag("--no-film", flags->no_film, "Without the video inside");
  verb->callback([flags, &session] {
    session.action = [flags, &session] {
      const fs::path path = make_report(flags->directory, !flags->no_film, session);
      fmt::print("report    {} ({:.1f} MB)\n", path.string(),
                 static_cast<double>(fs::file_size(path)) / 1e6);
    };
  });
}

}  // namespace touchdown
