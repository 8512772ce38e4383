#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/yaml.hpp"
#include "experiments/run_experiment.hpp"
#include "render/report/report.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::cli {

namespace {

namespace fs = std::filesystem;

struct FigureFlags {
  std::string directory, name, width;
  bool has_caption = false;
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

void figure(const FigureFlags& flags, const CliSession& session) {
  const double width = millimetres(flags.width);
  const render::ReportSubject subject = render::read_subject(flags.directory);
  const std::vector<std::string> names = figures_in(flags.directory);
  if (std::ranges::find(names, flags.name) == names.end()) {
    const std::string near = did_you_mean(flags.name, names);
    throw InputError(
        fmt::format("{}: has no figure '{}'{}", flags.directory, flags.name,
                    near.empty() ? fmt::format(" (it has: {})", fmt::join(names, ", ")) : near));
  }
  const fs::path script = fs::path(flags.directory) / "figures" / (flags.name + ".gp");
  experiments::ExperimentResult result = experiments::finish_run(
      flags.directory, {.out = {},
                        .command = subject.manifest.value("command", session.command),
                        .stop = session.stop});
  result.experiment.figures = {width, flags.has_caption, result.experiment.figures.heatmap,
                               flags.name};
  render::draw_pictures(result, {}, render::study_pictures(), false, session.stop);
  const render::FigureText text = render::figure_text(read_file(script));
  print("{}. {}\n\nfigure    {}\n", text.title, text.caption,
        fs::path(script).replace_extension(".pdf").string());
}

}  // namespace

void add_figure(CLI::App& program, const CliSession& session) {
  Verb verb(program, "figure",
            "touchdown figure runs/stairs/latest error_mujoco --width 88mm\n\n"
            "Draws a figure of a run directory of this build again, for print: no text is under\n"
            "6 pt, and panels that do not fit are below each other. Prints title and caption.");
  const auto flags = std::make_shared<FigureFlags>();
  verb.option("directory", &flags->directory, "Run directory").required();
  verb.option("name", &flags->name, "Figure: a file in its `figures`, without extension")
      .required();
  verb.option("--width", &flags->width, "Width in print, with its unit: 88mm, 8.8cm, 3.46in")
      .required();
  verb.flag("--caption", &flags->has_caption, "Draw title and caption, too");
  verb.action([flags, &session] { figure(*flags, session); });
}

}  // namespace touchdown::cli
