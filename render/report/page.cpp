#include "render/report/page.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/files.hpp"
#include "render/report/assets.hpp"

namespace touchdown::render {

namespace {

/// ", built from commit a1b2c3d4e5f6": the commit of the program that computed the numbers.
std::string built_from(const nlohmann::ordered_json& manifest) {
  const auto versions = manifest.find("versions");
  if (versions == manifest.end() || !versions->is_object()) return {};
  const auto written = versions->find("commit");
  if (written == versions->end() || !written->is_string()) return {};
  const auto commit = written->get<std::string>();
  if (commit.empty()) return {};
  return escaped(commit.starts_with("unknown") ? " (commit " + commit + ")"
                                               : ", built from commit " + commit);
}

}  // namespace

void write_page(const ReportSubject& subject, const std::filesystem::path& path,
                const std::string& header_html, std::vector<ReportSection> sections) {
  std::erase_if(sections, [](const ReportSection& section) { return section.html.empty(); });
  std::string body = "<header>\n" + header_html + "<nav aria-label=\"Contents\"><ul>\n";
  for (const ReportSection& section : sections) {
    body += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escaped(section.title));
  }
  body += "</ul></nav>\n</header>\n<main id=\"main\">\n";
  for (const ReportSection& section : sections) {
    body += fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}"
        "</h2>\n{2}</section>\n",
        section.id, escaped(section.title), section.html);
  }
  body += fmt::format(
      "</main>\n<footer><p>Computed by touchdown{}. This page needs no network.</p></footer>\n",
      built_from(subject.manifest));

  const std::string policy = fmt::format(
      "default-src 'none'; img-src data:; media-src data:; style-src {}; script-src {}; "
      "base-uri 'none'; form-action 'none'",
      policy_source(report_style.sha256), policy_source(report_script.sha256));
  write_atomically(path,
                   fmt::format(fmt::runtime(report_page.content), fmt::arg("policy", policy),
                               fmt::arg("title", escaped(subject.experiment.name) + " – touchdown"),
                               fmt::arg("style", report_style.content), fmt::arg("body", body),
                               fmt::arg("script", report_script.content)));
}

}  // namespace touchdown::render
