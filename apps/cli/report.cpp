#include "render/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/yaml.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_experiment.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::cli {

namespace {

namespace fs = std::filesystem;

struct ReportFlags {
  std::string directory, figure, width;
  bool has_caption = false;
  bool no_video = false;
  bool no_replay = false;
};

/// A width such as 88mm, 8.8cm or 3.46in, in mm.
double millimetres(const std::string& text) {
  const std::map<std::string, double> units = {{"mm", 1.0}, {"cm", 10.0}, {"in", 25.4}};
  std::istringstream words(text);
  double width = NAN;
  std::string unit, rest, near;
  words >> width >> unit >> rest;
  const auto known = units.find(unit);
  if (known != units.end() && rest.empty()) width *= known->second;
  const bool is_in_range =
      width >= experiments::narrowest_print && width <= experiments::widest_print;
  if (known != units.end() && rest.empty() && is_in_range) return width;
  if (known == units.end() && !unit.empty()) near = did_you_mean(unit, {"mm", "cm", "in"});
  throw InputError(
      fmt::format("--width {}: expected {:g} to {:g} mm with the unit mm, cm or in, as in 88mm{}",
                  text, experiments::narrowest_print, experiments::widest_print, near));
}

/// The names of the figures that a run drew.
std::vector<std::string> figures_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const fs::path& file : entries_in(directory / "figures")) {
    if (file.extension() == ".gp") names.push_back(file.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Draws a figure again, for print.
void draw_figure(const ReportFlags& flags, const CliSession& session) {
  const render::ReportSubject subject = render::read_subject(flags.directory);
  if (flags.width.empty() || flags.no_video || flags.no_replay) {
    throw InputError("--figure: expected --width, as in --width 88mm, and no option of the page");
  }
  const double width = millimetres(flags.width);
  const std::vector<std::string> names = figures_in(flags.directory);
  if (std::ranges::find(names, flags.figure) == names.end()) {
    const std::string near = did_you_mean(flags.figure, names);
    throw InputError(
        fmt::format("{}: has no figure '{}'{}", flags.directory, flags.figure,
                    near.empty() ? fmt::format(" (it has: {})", fmt::join(names, ", ")) : near));
  }
  const fs::path script = fs::path(flags.directory) / "figures" / (flags.figure + ".gp");
  experiments::ExperimentResult result = experiments::finish_run(
      flags.directory, {.out = {},
                        .command = subject.manifest.value("command", session.command),
                        .stop = session.stop});
  result.experiment.figures = {width, flags.has_caption, result.experiment.figures.heatmap,
                               flags.figure};
  render::draw_pictures(result, {}, render::study_pictures(), false, session.stop);
  const render::FigureText text = render::figure_text(read_file(script));
  print("{}. {}\n\nfigure    {}\n", text.title, text.caption,
        fs::path(script).replace_extension(".pdf").string());
}

void write_report(const ReportFlags& flags, const CliSession& session) {
  experiments::require_no_links(flags.directory);
  std::optional<experiments::DirectoryLock> lock;
  if (experiments::owner_of(flags.directory)) {
    lock.emplace(flags.directory, experiments::Access::alone, session.command);
  }
  const render::ReportSubject subject = render::read_subject(flags.directory);
  if (!flags.width.empty() || flags.has_caption) {
    throw InputError("--width and --caption: expected --figure NAME");
  }
  print_warnings(experiments::config_warnings(flags.directory));
  for (const std::string& name : subject.edited_tables) {
    print_warnings(
        {fmt::format("{}/tables/{}: was edited since the run wrote it: the report shows "
                     "it as it is now, `touchdown run` writes it anew",
                     flags.directory, name)});
  }
  std::vector<render::FilmedRun> filmed;
  if (subject.experiment.video.enabled && !(flags.no_video && flags.no_replay)) {
    filmed = render::filmed_runs(subject);
  }
  if (!flags.no_video) {
    render::film_for_report(filmed, subject.experiment, flags.directory, session.stop);
  }
  const fs::path path = render::make_report(subject, filmed, render::study_pictures(),
                                            {.film = !flags.no_video, .replay = !flags.no_replay});
  print("report    {} ({:.1f} MB)\n", path.string(), static_cast<double>(size_of_file(path)) / 1e6);
}

void report(const ReportFlags& flags, const CliSession& session) {
  flags.figure.empty() ? write_report(flags, session) : draw_figure(flags, session);
}

}  // namespace

void add_report(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "report",
      "touchdown report runs/stairs/latest\n"
      "touchdown report runs/stairs/latest --figure error_mujoco --width 88mm\n\n"
      "Writes report.html into an experiment's run directory and replaces an existing one. The\n"
      "report is one page that opens without a network connection. Its film is made if the run\n"
      "directory has none. With --figure it draws a figure of a run directory of this build\n"
      "again, for print: no text is under 6 pt, and panels that do not fit are below each other.\n"
      "It prints title and caption.");
  const auto flags = std::make_shared<ReportFlags>();
  verb.option("directory", &flags->directory, "Run directory").required();
  verb.flag("--no-video", &flags->no_video, "Leave out the video");
  verb.flag("--no-replay", &flags->no_replay, "Leave out the replay");
  verb.option("--figure", &flags->figure,
              "Draw only this figure: a file in `figures`, without extension")
      .value_name("NAME");
  verb.option("--width", &flags->width,
              "With --figure: width in print, with its unit: 88mm, 8.8cm, 3.46in");
  verb.flag("--caption", &flags->has_caption, "With --figure: draw title and caption, too");
  verb.action([flags, &session] { report(*flags, session); });
}

}  // namespace touchdown::cli
