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
  const auto& manifest = subject.manifest;
  std::string html =
      "<p>One command computes everything on this page again, from the configuration beside it. "
      "The "
      "same program gives the same numbers, to the last digit:</p>\n"
      "<pre><code>" +
      std::string(manifest.contains("python_estimators") ? "python3 -m " : "") +
      "touchdown run config.yaml</code></pre>\n";
  if (manifest.contains("command") && manifest["command"].is_string()) {
    html += fmt::format("<p>The command of this run:</p>\n<pre><code>{}</code></pre>\n",
                        escaped(manifest["command"].get<std::string>()));
  }
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
  html += table_html({"Versions, seeds and computing times", "versions and seeds", table}, 1);
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
    html += table_html({"Runs that are not scored", "failed runs", failed}, 1);
  }
  html += fmt::format(
      "<details><summary>The configuration, every default written out</summary>\n"
      "<pre tabindex=\"0\"><code>{}</code></pre></details>\n",
      escaped(subject.config_text));
  return {"reproduce", "Reproduction", html};
}

/// A jump to a flight goes to this time before the takeoff (s).
constexpr double run_up = 0.4;
/// The button of a flight stays highlighted until this time after the landing (s).
constexpr double follow_through = 0.4;

/// Buttons that jump to the flights of each wheel of a run, in a film until `end` (s).
std::string drops_html(const FilmedRun& run, double end) {
  const std::string engine = escaped(simulators::simulator_title(run.recording.info.simulator));
  std::array<std::size_t, models::wheel_count> count = {};
  std::array<std::string, models::wheel_count> items;
  for (const WheelFlight& flight : wheel_flights(run.recording, run.labels)) {
    if (flight.takeoff <= 0.0 || flight.landing > end) continue;
    ++count[flight.wheel];
    items[flight.wheel] += fmt::format(
        "<li><button type=\"button\" class=\"drop\" data-seek=\"{:.3f}\" data-end=\"{:.3f}\" "
        "aria-label=\"Play the flight of the {} wheel at {:.2f} seconds in {}\">{:.2f} s"
        "<small>{:.0f} ms in the air</small></button></li>\n",
        std::max(0.0, flight.takeoff - run_up), flight.landing + follow_through,
        flight.wheel == 0 ? "left" : "right", flight.takeoff, engine, flight.takeoff,
        1e3 * (flight.landing - flight.takeoff));
  }
  std::string html;
  for (const std::size_t wheel : {0U, 1U}) {
    html += fmt::format("<h3>{}, {} wheel: {}</h3>\n<ol>\n{}</ol>\n", engine,
                        wheel == 0 ? "left" : "right", experiments::plural(count[wheel], "flight"),
                        items[wheel]);
  }
  return html;
}

/// A link to the video in full size; empty without one.
std::string full_size_html(const FilmedRun& run, const fs::path& directory) {
  const logs::RecordingInfo& info = run.recording.info;
  const std::string name = experiments::video_name(info.simulator, info.scenario);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(directory / "videos" / name, error);
  if (error) return {};
  return fmt::format(" <a href=\"videos/{0}\">{0}</a> ({1})", escaped(name), size_text(bytes));
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
  std::vector<std::string> engines, full_size;
  std::string drops;
  for (const FilmedRun& run : runs) {
    engines.push_back(simulators::simulator_title(run.recording.info.simulator));
    drops += drops_html(run, std::min(end, longest_report_film));
    full_size.push_back(full_size_html(run, subject.directory));
  }
  std::erase(full_size, "");
  const std::string description = escaped(fmt::format(
      "The {} run in {}{}{}, {}. Below: the estimators' contact probabilities over the true "
      "contact (green: of the left wheel above, of the right one below), and torques. Thick lines "
      "are the left wheel.",
      runs.front().recording.info.scenario, fmt::join(engines, " and "),
      runs.size() > 1 ? ", side by side" : "",
      end > longest_report_film ? fmt::format(", its first {:.0f} seconds", longest_report_film)
                                : "",
      experiments::noise_text(subject.experiment.video.noise)));
  return fmt::format(
      "<div class=\"film\">\n<figure><video controls muted playsinline preload=\"auto\" "
      "aria-label=\"{0}\" poster=\"{1}\" src=\"{2}\"></video>\n"
      "<figcaption>{0}{3}{4}{5}</figcaption></figure>\n"
      "<div class=\"drops\">\n<p class=\"note\">Choose a flight of a wheel to play "
      "it:</p>\n{6}</div>\n</div>\n",
      description, data_uri("image/jpeg", film.picture), data_uri("video/mp4", film.video),
      full_size.empty() ? "" : " In full size, beside this file:", fmt::join(full_size, ","),
      full_size.empty() ? "" : ".", drops);
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
  for (ReportSection (*const section)(const ReportSubject&) :
       {heatmap_section, paper_section, figures_section, more_tables_section, reproduce_section}) {
    all.push_back(section(subject));
  }
  fs::path path = experiments::record_file(subject.directory, "report.html");
  write_page(subject, path, header_html(subject), std::move(all));
  return path;
}

}  // namespace touchdown::render
