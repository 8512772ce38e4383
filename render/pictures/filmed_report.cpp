#include "render/pictures/filmed_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/film/poster.hpp"
#include "render/film/video.hpp"
#include "render/pictures/film_progress.hpp"
#include "render/report/report.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

/// Longer runs are shown from their beginning only: the film lies inside the page (s).
constexpr double longest_film = 20.0;

ReportFlights flights_of(const FilmedRun& run, double end) {
  ReportFlights result{simulators::simulator_title(run.recording.info.simulator), {}};
  scoring::LabelConfig visible = run.labels;
  visible.debounce = std::max(visible.debounce, 0.05);
  for (const scoring::Flight& flight :
       scoring::flights(scoring::any_wheel(scoring::contact_labels(run.recording, visible)))) {
    const double period = run.recording.period();
    const ReportFlights::Span span{static_cast<double>(flight.takeoff) * period,
                                   static_cast<double>(flight.landing) * period};
    if (span.takeoff > 0.0 && span.landing <= end) result.flights.push_back(span);
  }
  return result;
}

ReportFilm film(const std::vector<FilmedRun>& runs, const fs::path& directory,
                const std::atomic<bool>* stop) {
  ReportFilm result;
  result.video = directory / "videos" / "report.mp4";
  result.poster = directory / "videos" / "report.jpg";
  VideoOptions options;
  options.width = 960;
  options.height = 540;
  options.crf = 28;
  options.labels = runs.front().labels;
  double end = 0.0;
  for (const FilmedRun& run : runs) {
    end = std::max(end, static_cast<double>(run.recording.steps()) * run.recording.period());
  }
  options.to = std::min(end, longest_film);
  std::string engines;
  std::vector<VideoSource> sources;
  std::error_code ignored;
  for (const FilmedRun& run : runs) {
    const recordings::RecordingInfo& info = run.recording.info;
    result.engines.push_back(flights_of(run, options.to));
    engines += (engines.empty() ? "" : " and ") + simulators::simulator_title(info.simulator);
    if (sources.size() < 2) sources.push_back(run.source());
    const fs::path full =
        fs::path("videos") / experiments::video_name(info.simulator, info.scenario);
    if (fs::exists(directory / full, ignored)) result.full_size.push_back(full);
  }
  result.description = fmt::format(
      "The {} run in {}{}{}. Below: what the estimators believe, over the true contact (green: "
      "dark "
      "where both wheels touch, light where one does), and torques; thick lines are the left "
      "wheel.",
      runs.front().recording.info.scenario, engines, runs.size() > 1 ? ", beside each other" : "",
      end > longest_film ? fmt::format(", its first {:.0f} seconds", longest_film) : "");
  options.progress = FilmProgress("filming for the report", stop);
  render_video(sources, options, result.video);
  render_poster(sources, options, NAN, result.poster);
  return result;
}

}  // namespace

fs::path make_report(const ReportSubject& subject, const std::vector<FilmedRun>& filmed,
                     const std::atomic<bool>* stop) {
  std::vector<ReportFilm> films;
  if (!filmed.empty()) films.push_back(film(filmed, subject.directory, stop));
  return write_report(subject, films);
}

fs::path make_report(const fs::path& run_directory, bool with_film, const std::atomic<bool>* stop) {
  const ReportSubject subject = read_subject(run_directory);
  const bool is_filmed = with_film && subject.experiment.video.enabled;
  return make_report(subject, is_filmed ? filmed_runs(subject) : std::vector<FilmedRun>(), stop);
}

}  // namespace touchdown::render
