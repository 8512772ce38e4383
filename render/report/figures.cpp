#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "core/files.hpp"
#include "render/gnuplot/figure.hpp"
#include "render/report/sections.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;

std::string longest_title(const std::string& script) {
  std::string best;
  for (const std::string word : {"set title '", "set multiplot", "set label"}) {
    for (std::size_t at = script.find(word); at != std::string::npos;
         at = script.find(word, at + 1)) {
      const std::size_t line_end = script.find('\n', at);
      const std::size_t open = script.find('\'', at);
      const std::size_t close = script.find('\'', open + 1);
      if (open == std::string::npos || close == std::string::npos || close > line_end) continue;
      if (close - open - 1 > best.size()) best = script.substr(open + 1, close - open - 1);
    }
  }
  while (best.ends_with('.')) best.pop_back();
  return best.empty() ? best : best + ".";
}

/// Pictures beyond this would make the page slow to open (bytes).
constexpr std::uintmax_t largest_picture = 2'000'000;

/// The texts in the figure's script. Missing ones are replaced by the figure's name and the longest
/// title that the script draws (`set title '…'`, `set label … '…'`).
FigureText text_of(const fs::path& figure) {
  std::string name = figure.stem().string();
  std::replace(name.begin(), name.end(), '_', ' ');
  const fs::path script = fs::path(figure).replace_extension(".gp");
  std::error_code ignored;
  if (!fs::is_regular_file(script, ignored)) return {name, {}, name};
  const std::string commands = read_file(script);
  FigureText text = figure_text(commands);
  if (text.title.empty()) text.title = name;
  if (text.caption.empty()) text.caption = longest_title(commands);
  if (text.alt.empty()) {
    text.alt = text.caption.empty() ? text.title : text.title + ": " + text.caption;
  }
  return text;
}

/// Whether a drawing needs the whole width of the page.
bool is_wide(const fs::path& svg) {
  if (svg.extension() != ".svg") return false;
  const std::string text = read_file(svg);
  const std::size_t box = text.find("viewBox=\"");
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
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

}  // namespace

ReportSection figures_section(const ReportSubject& subject) {
  ReportSection section{"figures", "Figures", {}};
  const fs::path folder = subject.directory / "figures";
  std::vector<fs::path> files;
  for (const fs::path& path : entries_in(folder)) {
    const bool drawn = path.extension() == ".svg";
    const bool painted =
        path.extension() == ".png" && !is_there(fs::path(path).replace_extension(".svg"));
    if (drawn || painted) files.push_back(path);
  }
  const std::vector<std::string>& simulators = subject.experiment.simulators;
  sort_by_engine(files, simulators);
  for (const fs::path& file : files) {
    fs::path shown = file;
    const fs::path painted = fs::path(file).replace_extension(".png");
    if (size_of_file(file) > largest_picture && is_there(painted)) {
      shown = painted;
    }
    if (size_of_file(shown) > largest_picture) continue;
    const FigureText text = text_of(file);
    section.html += fmt::format(
        "<figure{}><div class=\"pan\" tabindex=\"0\" role=\"group\" aria-label=\"{}\">"
        "<img loading=\"lazy\" alt=\"{}\" src=\"{}\"></div>\n<figcaption><b>{}.</b> {}",
        is_wide(file) ? " class=\"wide\"" : "", escaped(text.title), escaped(text.alt),
        data_uri(shown.extension() == ".svg" ? "image/svg+xml" : "image/png", shown),
        escaped(text.title), escaped(text.caption));
    for (const char* kind : {".svg", ".png", ".pdf", ".gp", ".dat", ".csv"}) {
      const fs::path beside = fs::path(file).replace_extension(kind);
      if (!is_there(beside)) continue;
      section.html += fmt::format(" <a href=\"figures/{0}\">{1}</a>",
                                  escaped(beside.filename().string()), kind + 1);
    }
    std::vector<fs::path> more_data = more_data_of(file);
    sort_by_engine(more_data, simulators);
    for (const fs::path& data : more_data) {
      section.html += fmt::format(" <a href=\"figures/{0}\">{0}</a>", escaped(data.string()));
    }
    section.html += "</figcaption></figure>\n";
  }
  if (!section.html.empty()) section.html = "<div class=\"gallery\">\n" + section.html + "</div>\n";
  return section;
}

}  // namespace touchdown::render
