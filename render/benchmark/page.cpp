#include "render/benchmark/page.hpp"

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/results/captions.hpp"
#include "render/benchmark/cards.hpp"
#include "render/benchmark/scene_tables.hpp"
#include "render/benchmark/standings_figure.hpp"
#include "render/gnuplot/figure.hpp"
#include "render/report/page.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

std::string header_of(const ReportSubject& subject, const BenchmarkScores& scores) {
  const auto fact = [](const char* name, const auto& rows, const auto& of) {
    return fact_html(name, std::to_string(names(rows, of).size()));
  };
  return fmt::format(
             "<p class=\"kicker\">Contact estimation on a wheeled biped</p>\n<h1>{}: which "
             "estimator, where?</h1>\n<p class=\"lead\">Balanced accuracy: the mean of the shares "
             "of contact and of flight that are told right; in a scene with one of the two, its "
             "share. 0.5 is what a constant answer earns where both happen.</p>\n<dl "
             "class=\"facts\">\n",
             escaped(subject.experiment.name)) +
         fact("estimators", scores.standings, [](const Standing& s) { return s.estimator; }) +
         fact("scenes", scores.scenes, [](const SceneScore& s) { return s.scene; }) +
         fact("robots", scores.standings, [](const Standing& s) { return s.robot; }) +
         fact("kinds of sensors", scores.standings, [](const Standing& s) { return s.sensors; }) +
         fact("noise settings", scores.standings, [](const Standing& s) { return s.noise; }) +
         fact_html("physics engines", std::to_string(subject.experiment.simulators.size())) +
         fmt::format(
             "</dl>\n<p class=\"note\">{} {} runs a scene and engine. Everything here as "
             "numbers: <a href=\"tables/benchmark.csv\">benchmark.csv</a>, <a "
             "href=\"tables/benchmark_standings.csv\">standings</a>, <a "
             "href=\"tables/benchmark_differences.csv\">differences</a>, all as <a "
             "href=\"tables/benchmark.json\">JSON</a>. The <a href=\"report.html\">report"
             "</a> has the rest of the experiment.</p>\n",
             escaped(experiments::conditions_text(subject.experiment)),
             subject.experiment.test.runs);
}

/// The figure of one robot with its sensors, where it was drawn.
std::string figure_html(const fs::path& run_directory, const Standing& place) {
  const fs::path stem = standings_stem(run_directory, place);
  const fs::path svg = stem.string() + ".svg";
  const fs::path script = stem.string() + ".gp";
  if (!fs::exists(svg) || !fs::exists(script)) return {};
  const FigureText text = figure_text(read_file(script));
  return fmt::format(
      "<figure class=\"wide\"><div class=\"pan\" tabindex=\"0\" role=\"group\" aria-label=\"{0}\">"
      "<img alt=\"{1}\" src=\"{2}\"></div></figure>\n",
      escaped(text.title), escaped(text.alt), data_uri("image/svg+xml", svg));
}

}  // namespace

fs::path write_benchmark_page(const ReportSubject& subject) {
  const BenchmarkScores scores = benchmark_scores(subject.directory);
  std::string standings;
  std::string scenes =
      "<p>The best of a column is bold, dark is bad. Scenes with a star are like none that "
      "anything "
      "was fitted to. A heading sorts; a cell says more.</p>\n";
  std::string last;
  for (const Standing& place : scores.standings) {
    if (place.setting == last) continue;
    const char* open = last.empty() ? " open" : "";
    last = place.setting;
    const auto folded = [&](const std::string& html) {
      return html.empty() ? html
                          : fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", open,
                                        escaped(last), html);
    };
    standings += folded(figure_html(subject.directory, place));
    scenes += folded(scenes_html(scores, last, subject.experiment.simulators));
  }
  fs::path path = subject.directory / "benchmark.html";
  write_page(subject, path, header_of(subject, scores),
             {{"standings", "Who stands where", standings},
              {"matrix", "Robots and sensors", matrix_html(scores)},
              {"scenes", "Scene by scene", scenes},
              {"cards", "Where each of them fails", cards_html(scores, subject.directory)}});
  return path;
}

}  // namespace touchdown::render
