#include "render/report/report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/files.hpp"
#include "render/report/assets.hpp"
#include "render/report/figures.hpp"
#include "render/report/html.hpp"
#include "render/report/noise.hpp"
#include "render/report/paper_tables.hpp"
#include "render/report/reproduce.hpp"
#include "render/report/results.hpp"
#include "render/report/tables.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;

std::string section_html(const ReportSection& section) {
  return fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}"
      "</h2>\n{2}</section>\n",
      section.id, escaped(section.title), section.html);
}

/// Puts each value where the page has its {{name}}, in one pass: values are never searched.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& values) {
  std::string result;
  while (true) {
    const std::size_t open = page.find("{{");
    const std::size_t close = page.find("}}", open);
    if (open == std::string_view::npos || close == std::string_view::npos) break;
    result += page.substr(0, open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto found = std::find_if(values.begin(), values.end(),
                                    [&](const auto& value) { return value.first == name; });
    if (found != values.end()) result += found->second;
    page.remove_prefix(close + 2);
  }
  return result.append(page);
}

}  // namespace

fs::path write_report(const ReportSubject& subject, const std::vector<ReportFilm>& films) {
  ReportSection film{"film", "Watch it", {}};
  for (const ReportFilm& one : films) film.html += film_html(one, subject.directory);
  std::vector<ReportSection> sections = {film,
                                         results_section(subject),
                                         heatmap_section(subject),
                                         paper_section(subject),
                                         figures_section(subject),
                                         more_tables_section(subject),
                                         reproduce_section(subject)};
  std::erase_if(sections, [](const ReportSection& section) { return section.html.empty(); });

  std::string body = "<header>\n" + header_html(subject) + "<nav aria-label=\"Contents\"><ul>\n";
  for (const ReportSection& section : sections) {
    body += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escaped(section.title));
  }
  body += "</ul></nav>\n</header>\n<main id=\"main\">\n";
  for (const ReportSection& section : sections) body += section_html(section);
  body += "</main>\n<footer><p>Written by touchdown. This page needs no network.</p></footer>\n";

  const std::string policy = fmt::format(
      "default-src 'none'; img-src data:; media-src data:; style-src {}; script-src {}; "
      "base-uri 'none'; form-action 'none'",
      policy_source(report_style.sha256), policy_source(report_script.sha256));
  fs::path path = subject.directory / "report.html";
  write_atomically(path, filled(report_page.content,
                                {{"policy", policy},
                                 {"title", escaped(subject.experiment.name) + " – touchdown"},
                                 {"style", report_style.content},
                                 {"body", body},
                                 {"script", report_script.content}}));
  return path;
}

}  // namespace touchdown::render
