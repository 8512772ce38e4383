#include "render/pictures/filmed_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/film/video.hpp"
#include "render/report/html.hpp"
#include "render/report/report.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

/// Only this much of a longer run is shown, because the page contains the film (s).
constexpr double longest_film = 20.0;
/// A jump to a drop goes to this time before the takeoff (s).
constexpr double run_up = 0.4;
/// The button of a drop stays highlighted until this time after the landing (s).
constexpr double follow_through = 0.4;

/// Buttons that jump to a run's flights, in a film until `end` (s).
std::string drops_html(const FilmedRun& run, double end) {
  const std::string engine = escaped(simulators::simulator_title(run.recording.info.simulator));
  scoring::LabelConfig visible = run.labels;
  visible.debounce = std::max(visible.debounce, 0.05);
  std::size_t drops = 0;
  std::string items;
  for (const scoring::Flight& flight :
       scoring::flights(scoring::any_wheel(scoring::contact_labels(run.recording, visible)))) {
    const double takeoff = static_cast<double>(flight.takeoff) * run.recording.period();
    const double landing = static_cast<double>(flight.landing) * run.recording.period();
    if (takeoff <= 0.0 || landing > end) continue;
    ++drops;
    items += fmt::format(
        "<li><button type=\"button\" class=\"drop\" data-seek=\"{:.3f}\" data-end=\"{:.3f}\" "
        "aria-label=\"Play the drop at {:.2f} seconds in {}\">{:.2f} s<small>{:.0f} ms in the air"
        "</small></button></li>\n",
        std::max(0.0, takeoff - run_up), landing + follow_through, takeoff, engine, takeoff,
        1e3 * (landing - takeoff));
  }
  return fmt::format("<h3>{}: {} {}</h3>\n<ol>\n{}</ol>\n", engine, drops,
                     drops == 1 ? "drop" : "drops", items);
}

/// A link to the video in full size; empty without one.
std::string full_size_html(const FilmedRun& run, const fs::path& directory) {
  const recordings::RecordingInfo& info = run.recording.info;
  const std::string name = experiments::video_name(info.simulator, info.scenario);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(directory / "videos" / name, error);
  if (error) return {};
  return fmt::format(" <a href=\"videos/{0}\">{0}</a> ({1})", escaped(name), size_text(bytes));
}

/// A small video inside the report, and links to the files in full size beside it.
std::string film_html(const std::vector<FilmedRun>& runs, const fs::path& directory,
                      const std::atomic<bool>* stop) {
  const fs::path video = directory / "videos" / "report.mp4";
  const fs::path poster = directory / "videos" / "report.jpg";
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
  std::vector<std::string> engines, full_size;
  std::string drops;
  std::vector<VideoSource> sources;
  for (const FilmedRun& run : runs) {
    engines.push_back(simulators::simulator_title(run.recording.info.simulator));
    drops += drops_html(run, options.to);
    if (sources.size() < 2) sources.push_back(run.source());
    full_size.push_back(full_size_html(run, directory));
  }
  std::erase(full_size, "");
  options.progress = film_progress("filming for the report", stop);
  render_video(sources, options, video);
  render_poster(sources, options, NAN, poster);
  const std::string description = escaped(fmt::format(
      "The {} run in {}{}{}. Below: the estimators' contact probabilities over the true contact "
      "(green: dark where both wheels are in contact, light where one is), and torques. Thick "
      "lines are the left wheel.",
      runs.front().recording.info.scenario, fmt::join(engines, " and "),
      runs.size() > 1 ? ", side by side" : "",
      end > longest_film ? fmt::format(", its first {:.0f} seconds", longest_film) : ""));
  return fmt::format(
      "<div class=\"film\">\n<figure><video controls muted playsinline preload=\"auto\" "
      "aria-label=\"{0}\" poster=\"{1}\" src=\"{2}\"></video>\n"
      "<figcaption>{0}{3}{4}{5}</figcaption></figure>\n"
      "<div class=\"drops\">\n<p class=\"note\">Choose a drop to play it:</p>\n{6}</div>\n</div>\n",
      description, data_uri("image/jpeg", poster), data_uri("video/mp4", video),
      full_size.empty() ? "" : " In full size, beside this file:", fmt::join(full_size, ","),
      full_size.empty() ? "" : ".", drops);
}

}  // namespace

fs::path make_report(const ReportSubject& subject, const std::vector<FilmedRun>& filmed,
                     const std::vector<StudyPictures>& studies, const std::atomic<bool>* stop) {
  std::string films = filmed.empty() ? "" : film_html(filmed, subject.directory, stop);
  std::vector<ReportSection> sections;
  for (const StudyPictures& study : studies) {
    if (!study.is_requested(subject.experiment)) continue;
    if (study.section) sections.push_back(study.section(subject));
    if (study.film_html) films += study.film_html(subject);
  }
  return write_report(subject, films, sections);
}

}  // namespace touchdown::render
