#include "render/figures/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/results/captions.hpp"
#include "render/gnuplot/figure.hpp"
#include "render/report/sections.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;

/// Pictures beyond this would make the page slow to open (bytes).
constexpr std::uintmax_t largest_picture = 2'000'000;

/// The texts in the figure's script. A missing title or description is the figure's name.
FigureText text_of(const fs::path& figure) {
  std::string name = figure.stem().string();
  std::replace(name.begin(), name.end(), '_', ' ');
  const fs::path script = fs::path(figure).replace_extension(".gp");
  std::error_code ignored;
  if (!fs::is_regular_file(script, ignored)) return {name, {}, name};
  const std::string commands = read_file(script);
  FigureText text = figure_text(commands);
  if (text.title.empty()) text.title = name;
  if (text.alt.empty()) {
    text.alt = text.caption.empty() ? text.title : text.title + ": " + text.caption;
  }
  // Most drawings have their caption in them (FigureFrame::begin); none is printed twice.
  if (commands.find("set label 1002 '") != commands.find("set label 1002 ''")) text.caption.clear();
  return text;
}

/// Whether a drawing needs the whole width of the page.
bool is_wide(const fs::path& svg) {
  if (svg.extension() != ".svg") return false;
  const std::string text = read_file(svg);
  const std::size_t box = text.find("viewBox=\"");
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;  // px
  if (box == std::string::npos) return false;
  std::istringstream(text.substr(box + 9, 80)) >> left >> top >> width >> height;
  return width > 1.4 * height || width >= 1200.0;
}

/// Further data files of a figure: `<figure>_….dat`.
std::vector<fs::path> more_data_of(const fs::path& figure) {
  const std::string beginning = figure.stem().string() + "_";
  std::vector<fs::path> names;
  for (const fs::path& entry : entries_in(figure.parent_path())) {
    const std::string name = entry.filename().string();
    const bool is_its_own = is_there(fs::path(entry).replace_extension(".svg"));
    if (name.starts_with(beginning) && name.ends_with(".dat") && !is_its_own) {
      names.emplace_back(name);
    }
  }
  return names;
}

/// The sort key of a file: its name without the engine, then the engine's index in the experiment.
std::pair<std::string, std::ptrdiff_t> sort_key(const fs::path& file,
                                                const std::vector<std::string>& simulators) {
  std::string name = file.stem().string();
  for (auto engine = simulators.begin(); engine != simulators.end(); ++engine) {
    const std::size_t at = name.find("_" + *engine);
    if (at == std::string::npos) continue;
    name.erase(at, 1 + engine->size());
    return {name, engine - simulators.begin()};
  }
  return {name, -1};
}

void sort_by_engine(std::vector<fs::path>& files, const std::vector<std::string>& simulators) {
  std::sort(files.begin(), files.end(), [&](const fs::path& a, const fs::path& b) {
    const auto first = sort_key(a, simulators), second = sort_key(b, simulators);
    return first != second ? first < second : a < b;
  });
}

/// What a cell shows when the reader chooses it.
std::string readout(const TableRow& cell, const NoiseMaps& maps,
                    const experiments::Experiment& experiment) {
  const auto level = [&](const NoiseAxis& axis) {
    return fmt::format("{} {:.4g} {}", axis.name, cell.number(axis.column), axis.unit);
  };
  const experiments::PointMetric& metric = experiments::mapped_metric(experiment);
  std::string text = fmt::format(
      "{}, {}: {}, {}: {} {}", simulators::simulator_title(cell.text("simulator")),
      experiments::estimator_title_in(experiment, cell.text("estimator")), level(maps.y),
      level(maps.x), metric.title, with_interval(cell.interval(metric.name)));
  const double always_contact = cell.number("always_contact_success");
  if (metric.of == &scoring::Classification::success && std::isfinite(always_contact)) {
    text += fmt::format("; always contact {:.3f}", always_contact);
  }
  return text;
}

/// The readouts of one estimator's map, from the lowest row on.
Json readouts(const std::vector<TableRow>& cells, const std::string& estimator,
              const NoiseMaps& maps, const experiments::Experiment& experiment) {
  Json texts = Json::array();
  for (const double y : maps.y.levels) {
    for (const double x : maps.x.levels) {
      const auto cell = std::ranges::find_if(cells, [&](const TableRow& one) {
        return one.text("estimator") == estimator && one.number(maps.x.column) == x &&
               one.number(maps.y.column) == y;
      });
      texts.push_back(cell == cells.end() ? "not part of this study"
                                          : readout(*cell, maps, experiment));
    }
  }
  return texts;
}

/// The panels of a drawing by the margins in its script: left, top, width and height as shares of
/// the picture. Cells divide a map's panel evenly, the first row is the lowest.
std::vector<std::array<double, 4>> panels_in(const fs::path& drawing) {
  const fs::path script = fs::path(drawing).replace_extension(".gp");
  if (!is_there(script)) return {};
  const std::string text = read_file(script);
  static const std::regex margins(
      "set lmargin at screen (.*)\nset rmargin at screen (.*)\n"
      "set tmargin at screen (.*)\nset bmargin at screen (.*)\n");
  std::vector<std::array<double, 4>> panels;
  for (std::sregex_iterator at(text.begin(), text.end(), margins), end; at != end; ++at) {
    const auto share = [&](std::size_t i) { return std::stod((*at)[i].str()); };
    panels.push_back({share(1), 1.0 - share(3), share(2) - share(1), share(3) - share(4)});
  }
  return panels;
}

/// The readouts of a drawn map and their places in it, for `script.js`. Empty for a drawing with
/// other panels.
std::string map_overlay(const ReportSubject& subject, const fs::path& drawing,
                        const std::string& simulator, const NoiseMaps& maps) {
  const std::vector<std::string> estimators = mapped_estimators(subject.experiment);
  const std::vector<std::array<double, 4>> panels = panels_in(drawing);
  if (panels.size() != estimators.size()) return {};
  Json data = {{"columns", maps.x.levels.size()}, {"panels", Json::array()}};
  const Table cells = mapped_cells(subject.tables.cells, maps, simulator);
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    data["panels"].push_back(
        {{"place", panels[i]},
         {"cells", readouts(cells.all(), estimators[i], maps, subject.experiment)}});
  }
  return inline_json(data);
}

std::string gallery(Json figures, bool has_readouts) {
  std::erase(figures.get_ref<Json::array_t&>(), Json());  // too large
  if (figures.empty()) return {};
  return html_of("figures.html", {{"has_readouts", has_readouts}, {"figures", std::move(figures)}});
}

}  // namespace

Json figure_members(const fs::path& file, const std::vector<std::string>& simulators,
                    const std::string& readouts) {
  fs::path shown = file;
  const fs::path painted = fs::path(file).replace_extension(".png");
  if (size_of_file(file) > largest_picture && is_there(painted)) shown = painted;
  if (size_of_file(shown) > largest_picture) return {};
  Json files = Json::array();
  for (const char* kind : {".svg", ".png", ".pdf", ".gp", ".dat", ".csv"}) {
    const fs::path beside = fs::path(file).replace_extension(kind);
    if (is_there(beside)) {
      files.push_back({{"file", beside.filename().string()}, {"name", kind + 1}});
    }
  }
  std::vector<fs::path> more_data = more_data_of(file);
  sort_by_engine(more_data, simulators);
  for (const fs::path& data : more_data) {
    files.push_back({{"file", data.string()}, {"name", data.string()}});
  }
  const FigureText text = text_of(file);
  const char* const type = shown.extension() == ".svg" ? "image/svg+xml" : "image/png";
  return {{"title", text.title},      {"caption", text.caption},          {"alt", text.alt},
          {"is_wide", is_wide(file)}, {"picture", data_uri(type, shown)}, {"readouts", readouts},
          {"files", std::move(files)}};
}

FigureSections figure_sections(const ReportSubject& subject) {
  const std::vector<std::string>& simulators = subject.experiment.simulators;
  const fs::path folder = subject.directory / "figures";
  std::vector<fs::path> drawings, files;
  Json with_readouts = Json::array(), others = Json::array();
  for (const NoiseMaps& maps : noise_maps(subject.experiment)) {
    for (const std::string& simulator : simulators) {
      const fs::path drawing = folder / fmt::format("{}_{}.svg", maps.name, simulator);
      if (!is_there(drawing)) continue;
      const std::string overlay = map_overlay(subject, drawing, simulator, maps);
      if (overlay.empty()) continue;
      drawings.push_back(drawing);
      with_readouts.push_back(figure_members(drawing, simulators, overlay));
    }
  }
  for (const fs::path& path : entries_in(folder)) {
    const bool is_map = std::ranges::find(drawings, path) != drawings.end();
    const bool drawn = path.extension() == ".svg" && !is_map;
    const bool painted =
        path.extension() == ".png" && !is_there(fs::path(path).replace_extension(".svg"));
    if (drawn || painted) files.push_back(path);
  }
  sort_by_engine(files, simulators);
  for (const fs::path& file : files) others.push_back(figure_members(file, simulators));
  return {{"noise", "Under sensor noise", gallery(std::move(with_readouts), true)},
          {"figures", "Figures", gallery(std::move(others), false)}};
}

}  // namespace touchdown::render
