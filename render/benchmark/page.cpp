#include "render/benchmark/page.hpp"

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/run_directory/recorded_files.hpp"
#include "render/benchmark/cards.hpp"
#include "render/benchmark/scene_tables.hpp"
#include "render/benchmark/standings_figure.hpp"
#include "render/gnuplot/figure.hpp"
#include "render/report/html.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

std::string header_of(const ReportSubject& subject, const BenchmarkScores& scores) {
  const auto fact = [](const char* name, const auto& rows, const auto& of) {
    return fact_html(name, std::to_string(names(rows, of).size()));
  };
  return fmt::format(
             "<p class=\"kicker\">Contact estimation on a wheeled biped</p>\n<h1>{}: which "
             "estimator works where?</h1>\n<p class=\"lead\">Balanced accuracy is the mean of the "
             "recall of contact and the recall of flight. In a scene with only one of the two, it "
             "is "
             "the recall of that one. A constant answer scores 0.5 where both occur.</p>\n<dl "
             "class=\"facts\">\n",
             escaped(subject.experiment.name)) +
         fact("estimators", scores.standings, [](const Standing& s) { return s.estimator; }) +
         fact("scenes", scores.scenes, [](const SceneScore& s) { return s.scene; }) +
         fact("robots", scores.standings, [](const Standing& s) { return s.robot; }) +
         fact("sensor profiles", scores.standings, [](const Standing& s) { return s.sensors; }) +
         fact("noise settings", scores.standings, [](const Standing& s) { return s.noise; }) +
         fact_html("physics engines", std::to_string(subject.experiment.simulators.size())) +
         fmt::format(
             "</dl>\n<p class=\"note\">{} {} runs per scene and engine. All numbers of "
             "this page: <a href=\"tables/benchmark.csv\">benchmark.csv</a>, <a "
             "href=\"tables/benchmark_standings.csv\">standings</a>, <a "
             "href=\"tables/benchmark_differences.csv\">differences</a>, all as <a "
             "href=\"tables/benchmark.json\">JSON</a>. The <a href=\"report.html\">report"
             "</a> shows the rest of the experiment.</p>\n",
             escaped(experiments::conditions_text(subject.experiment)),
             subject.experiment.test.runs);
}

/// The figure of one robot with its sensors; empty when it was not drawn.
std::string figure_html(const fs::path& run_directory, const Standing& standing) {
  const fs::path stem = standings_stem(run_directory, standing);
  const fs::path svg = stem.string() + ".svg";
  const fs::path script = stem.string() + ".gp";
  if (!is_there(svg) || !is_there(script)) return {};
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
      "<p>Cells show balanced accuracy: the best of each column is bold, and darker cells are "
      "worse. A star marks scenes that are unlike all training scenes. Click a heading to sort; "
      "point at a cell for more numbers.</p>\n";
  std::string last;
  for (const Standing& standing : scores.standings) {
    if (standing.setting == last) continue;
    const char* open = last.empty() ? " open" : "";
    last = standing.setting;
    const auto folded = [&](const std::string& html) {
      return html.empty() ? html
                          : fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", open,
                                        escaped(last), html);
    };
    standings += folded(figure_html(subject.directory, standing));
    scenes += folded(scenes_html(scores, last, subject.experiment.simulators));
  }
  fs::path path = experiments::record_file(subject.directory, "benchmark.html");
  write_page(subject, path, header_of(subject, scores),
             {{"standings", "Ranking", standings},
              {"matrix", "Robots and sensors", matrix_html(scores)},
              {"scenes", "Scene by scene", scenes},
              {"cards", "Failures of each estimator", cards_html(scores, subject.directory)}});
  return path;
}

}  // namespace touchdown::render
