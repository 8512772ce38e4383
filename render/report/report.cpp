#include "render/report/report.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "render/report/sections.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

std::string text_of(const nlohmann::ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.3g}", value.get<double>());
  return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void add_rows(const nlohmann::ordered_json& manifest, const char* key, const std::string& prefix,
              TextTable& table) {
  if (!manifest.contains(key) || !manifest[key].is_object()) return;
  for (const auto& [name, value] : manifest[key].items()) {
    if (std::string(key) == "host" && name == "name") continue;
    table.rows.push_back({prefix + name, text_of(value)});
  }
}

/// The command, versions, seeds and configuration that reproduce the numbers.
ReportSection reproduce_section(const ReportSubject& subject) {
  const Json& manifest = subject.manifest;
  TextTable table{{"quantity", "value"}, {}};
  for (const char* key : {"id", "finished_at"}) {
    if (manifest.contains(key)) table.rows.push_back({key, text_of(manifest[key])});
  }
  for (const std::string& name : subject.edited_tables) {
    table.rows.push_back({"edited since the run", "tables/" + name});
  }
  add_rows(manifest, "versions", "version: ", table);
  add_rows(manifest, "seeds", "seed: ", table);
  add_rows(manifest, "host", "", table);
  add_rows(manifest, "timings_s", "seconds to ", table);
  for (auto& row : table.rows) {
    std::replace(row[0].begin(), row[0].end(), '_', ' ');
  }
  Json tables = Json::array();
  tables.push_back(
      table_members({"Versions, seeds and computing times", "versions and seeds", table}, 1));
  if (manifest.contains("failed_runs") && manifest["failed_runs"].is_array() &&
      !manifest["failed_runs"].empty()) {
    TextTable failed{{"recording", "outcome"}, {}};
    for (const auto& run : manifest["failed_runs"]) {
      if (!run.is_object()) continue;  // the file may have been edited
      const auto text = [&](const char* key) {
        return run.contains(key) ? text_of(run[key]) : std::string();
      };
      failed.rows.push_back(
          {text("recording"), run.contains("ending") ? text("ending") : text("outcome")});
    }
    tables.push_back(table_members({"Runs that are not scored", "failed runs", failed}, 1));
  }
  const bool has_command = manifest.contains("command") && manifest["command"].is_string();
  return {"reproduce", "Reproduction",
          html_of("reproduce.html", {{"is_python", manifest.contains("python_estimators")},
                                     {"command", has_command ? manifest["command"] : Json("")},
                                     {"tables", std::move(tables)},
                                     {"config", subject.config_text}})};
}

/// A jump to a flight goes to this time before the takeoff (s).
constexpr double run_up = 0.4;
/// The button of a flight stays highlighted until this time after the landing (s).
constexpr double follow_through = 0.4;

/// The flights of each wheel of a run in the report's film. Its buttons jump to them.
void add_wheels(const FilmedRun& run, Json& wheels) {
  const std::string engine = simulators::simulator_title(run.recording.info.simulator);
  std::array<Json, models::wheel_count> flights = {Json::array(), Json::array()};
  for (const WheelFlight& flight : wheel_flights(run.recording, run.labels)) {
    if (flight.takeoff <= 0.0 || flight.landing > longest_report_film) continue;
    flights[flight.wheel].push_back(
        {{"seek", fmt::format("{:.3f}", std::max(0.0, flight.takeoff - run_up))},
         {"end", fmt::format("{:.3f}", flight.landing + follow_through)},
         {"time", fmt::format("{:.2f}", flight.takeoff)},
         {"duration", fmt::format("{:.0f}", 1e3 * (flight.landing - flight.takeoff))}});
  }
  for (const std::size_t wheel : {0U, 1U}) {
    wheels.push_back({{"engine", engine},
                      {"wheel", wheel == 0 ? "left" : "right"},
                      {"count", experiments::plural(flights[wheel].size(), "flight")},
                      {"flights", std::move(flights[wheel])}});
  }
}

/// The small video inside the report, and links to the files in full size beside it. Empty without
/// the video.
std::string film_html(const ReportSubject& subject, const std::vector<FilmedRun>& runs) {
  const ReportFilm film = report_film(subject.directory);
  if (runs.empty() || !is_there(film.video) || !is_there(film.picture)) return {};
  double end = 0.0;
  for (const FilmedRun& run : runs) {
    end = std::max(end, static_cast<double>(run.recording.steps()) * run.recording.period());
  }
  std::vector<std::string> engines;
  Json wheels = Json::array(), files = Json::array();
  for (const FilmedRun& run : runs) {
    const logs::RecordingInfo& info = run.recording.info;
    engines.push_back(simulators::simulator_title(info.simulator));
    add_wheels(run, wheels);
    const std::string name = experiments::video_name(info.simulator, info.scenario);
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(subject.directory / "videos" / name, error);
    if (error) continue;
    files.push_back(
        {{"separator", files.empty() ? "" : ","}, {"name", name}, {"size", size_text(bytes)}});
  }
  const std::string description = fmt::format(
      "The {} run in {}{}{}, {}. Below: the estimators' contact probabilities over the true "
      "contact (green: of the left wheel above, of the right one below), and torques. Thick lines "
      "are the left wheel.",
      runs.front().recording.info.scenario, fmt::join(engines, " and "),
      runs.size() > 1 ? ", side by side" : "",
      end > longest_report_film ? fmt::format(", its first {:.0f} seconds", longest_report_film)
                                : "",
      experiments::noise_text(subject.experiment.video.noise));
  return html_of("film.html", {{"description", description},
                               {"picture", data_uri("image/jpeg", film.picture)},
                               {"video", data_uri("video/mp4", film.video)},
                               {"has_files", !files.empty()},
                               {"files", std::move(files)},
                               {"wheels", std::move(wheels)}});
}

ReportSection replay_section(const std::vector<FilmedRun>& filmed) {
  ReportSection section{"replay", "Replay"};
  if (filmed.empty()) return section;
  std::vector<VideoSource> sources;
  for (const FilmedRun& run : filmed) sources.push_back(run.source());
  section.html = replay_html(sources, filmed.front().labels);
  return section;
}

}  // namespace

fs::path make_report(const ReportSubject& subject, const std::vector<FilmedRun>& filmed,
                     const std::vector<StudyPictures>& studies, const ReportParts& parts) {
  std::string films = parts.film ? film_html(subject, filmed) : "";
  std::vector<ReportSection> of_studies;
  for (const StudyPictures& study : studies) {
    if (!study.is_requested(subject.experiment)) continue;
    if (study.section) of_studies.push_back(study.section(subject));
    if (parts.film && study.film_html) films += study.film_html(subject);
  }
  std::vector<ReportSection> all = {{"film", "Film", films}};
  if (parts.replay) all.push_back(replay_section(filmed));
  all.push_back(estimators_section(subject));
  all.push_back(results_section(subject));
  all.insert(all.end(), of_studies.begin(), of_studies.end());
  auto [maps, figures] = figure_sections(subject);
  all.push_back(std::move(maps));
  all.push_back(paper_section(subject));
  all.push_back(std::move(figures));
  all.push_back(more_tables_section(subject));
  all.push_back(reproduce_section(subject));
  fs::path path = experiments::record_file(subject.directory, "report.html");
  write_page(subject, path, report_header(subject), all);
  return path;
}

}  // namespace touchdown::render
