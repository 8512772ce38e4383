#include "experiments/studies/closed_loop.hpp"

#include <algorithm>
#include <cmath>
#include <list>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/results/odometry.hpp"
#include "render/film/video.hpp"
#include "render/palette.hpp"
#include "render/report/filmed_run.hpp"
#include "render/report/html.hpp"
#include "render/studies/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

using experiments::ClosedLoopConfig;

const experiments::ClosedLoopFilm& film_of(const experiments::Experiment& experiment) {
  return *experiment.studies.at<ClosedLoopConfig>().film;
}

std::string loop_film_stem(const std::string& simulator) { return "closed_loop_" + simulator; }

/// The cell of the film's point with this contact source.
experiments::ClosedLoopCell filmed_cell(const experiments::Experiment& experiment,
                                        const std::string& simulator, const std::string& contact) {
  const experiments::ClosedLoopFilm& film = film_of(experiment);
  const std::vector<experiments::ClosedLoopCell> cells = experiments::closed_loop_cells(experiment);
  return *std::find_if(cells.begin(), cells.end(), [&](const experiments::ClosedLoopCell& cell) {
    return cell.simulator == simulator && cell.law == film.law && cell.contact == contact &&
           cell.scene == static_cast<std::size_t>(film.scene) &&
           cell.point == static_cast<std::size_t>(film.point);
  });
}

/// As in the survival figures.
unsigned colour_of(const std::string& contact, const std::vector<std::string>& estimators) {
  if (contact == "truth") return truth_colour;
  if (contact == "always") return always_contact_colour;
  return line_colour(line_type_of(estimators, contact));
}

FilmedRun rollout(const experiments::RunRequest& request, const experiments::ClosedLoopCell& cell,
                  const experiments::FittedModels& models, scenarios::CompiledScenes& scenes,
                  const std::atomic<bool>* stop) {
  experiments::ClosedLoopRun run =
      experiments::run_closed_loop(request, cell, film_of(request.experiment).run, models, scenes,
                                   [stop] { return stop == nullptr || !*stop; });
  BeliefTrack track;
  track.name = experiments::contact_title(cell.contact);
  track.colour = colour_of(cell.contact, request.experiment.estimators);
  track.p_contact = std::move(run.trace.p_contact);
  return {scenarios::compile_robot(run.scenario),
          std::move(run.recording),
          {std::move(track)},
          request.experiment.labels};
}

/// The time at which the first run falls or ends (s); the runs differ visibly by then.
double first_end(const std::list<FilmedRun>& runs) {
  double end = HUGE_VAL;
  for (const FilmedRun& run : runs) {
    end = std::min(end, static_cast<double>(run.recording.steps() - 1) * run.recording.period());
  }
  return end;
}

/// Films the run that `closed_loop.film` names, in every engine, as
/// `videos/closed_loop_<engine>.mp4` with a still picture beside it. Up to four contact sources
/// start from the same conditions and are shown side by side, with their contact probabilities
/// below. The runs are simulated again for the film.
void film_closed_loop(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  const experiments::RunRequest request = experiments::read_request(result.directory.path());
  const experiments::Experiment& experiment = request.experiment;
  scenarios::CompiledScenes scenes;
  for (const std::string& simulator : experiment.simulators) {
    std::list<FilmedRun> runs;
    std::vector<VideoSource> sources;
    for (const std::string& contact : film_of(experiment).contact) {
      runs.push_back(rollout(request, filmed_cell(experiment, simulator, contact), result.models,
                             scenes, stop));
      sources.push_back(runs.back().source());
      sources.back().label = experiments::contact_title(contact);
    }
    VideoOptions options = film_of_width(experiment.video.width, 3.0 / 4.0);
    options.labels = experiment.labels;
    options.workers = experiment.workers;
    options.progress = film_progress(fmt::format("filming the closed loop in {}", simulator), stop);
    const std::string stem = loop_film_stem(simulator);
    render_video(sources, options, result.directory.own_file("videos", stem + ".mp4"));
    render_poster(sources, options, first_end(runs),
                  result.directory.own_file("videos", stem + ".jpg"));
  }
}

/// A still picture with a link for each of these films in the run directory; empty without films.
std::string closed_loop_films_html(const ReportSubject& subject) {
  const fs::path folder = subject.directory / "videos";
  Json films = Json::array();
  for (const std::string& simulator : subject.experiment.simulators) {
    const std::string name = loop_film_stem(simulator) + ".mp4";
    const fs::path picture = folder / (loop_film_stem(simulator) + ".jpg");
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(folder / name, error);
    if (error || !is_there(picture)) continue;
    films.push_back({{"file", name},
                     {"engine", simulators::simulator_title(simulator)},
                     {"picture", data_uri("image/jpeg", picture)},
                     {"size", size_text(bytes)}});
  }
  return html_of("closed_loop_films.html", {{"films", std::move(films)}});
}

}  // namespace

StudyPictures closed_loop_pictures() {
  const auto is_filmed = [](const experiments::Experiment& experiment) {
    const auto* const config = experiment.studies.find<ClosedLoopConfig>();
    return config != nullptr && config->film;
  };
  return {.is_requested = is_filmed, .film = film_closed_loop, .film_html = closed_loop_films_html};
}

}  // namespace touchdown::render
