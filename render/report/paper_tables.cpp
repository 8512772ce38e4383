#include "render/report/paper_tables.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "experiments/tables/captions.hpp"
#include "render/report/tables.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

template <typename Row>
std::vector<Row> rows_at(const std::vector<Row>& rows, const noise::NoiseCell& cell) {
  std::vector<Row> found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [&](const Row& row) { return row.cell == cell; });
  return found;
}

std::string with_engine_titles(experiments::CaptionedTable table) {
  for (auto& row : table.table.rows) row[0] = simulators::simulator_title(row[0]);
  return table_html(table, 2);
}

}  // namespace

ReportSection paper_section(const ReportSubject& subject) {
  ReportSection section{"paper", "Beside the paper", {}};
  for (const noise::NoiseCell& cell : subject.experiment.highlights) {
    const std::vector<experiments::ScoreSummary> scores = rows_at(subject.summary.scores, cell);
    if (scores.empty()) continue;
    const std::string how = fmt::format(
        "Torque noise {} N·m, accelerometer noise {} m/s², {}.", cell.torque, cell.accelerometer,
        experiments::plural(static_cast<std::size_t>(subject.experiment.noise.seeds),
                            "noise seed"));
    std::string tables;
    for (const experiments::CaptionedTable& table : experiments::paper_tables(scores, how)) {
      tables += with_engine_titles(table);
    }
    const std::vector<experiments::Difference> compared =
        rows_at(subject.summary.differences, cell);
    if (!compared.empty()) {
      experiments::CaptionedTable table = experiments::difference_text_table(compared);
      table.caption =
          "Paired differences: both estimators heard the same runs through the same noise. " + how;
      tables += with_engine_titles(table);
    }
    section.html +=
        fmt::format("<details{}><summary>{} N·m, {} m/s²</summary>\n{}</details>\n",
                    section.html.empty() ? " open" : "", cell.torque, cell.accelerometer, tables);
  }
  if (!section.html.empty()) {
    section.html =
        fmt::format(
            "<p>The last column repeats what the paper measured on the real robot: another "
            "machine, ten other drops, labels by hand, no intervals. It is a reference, not "
            "a mark to pass. {}</p>\n",
            escaped(experiments::conditions_text(subject.experiment))) +
        section.html;
  }
  return section;
}

}  // namespace touchdown::render
