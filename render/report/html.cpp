#include "render/report/html.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "report_assets.hpp"

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

constexpr std::pair<char, std::string_view> markup[] = {
    {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};

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

std::string escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    const auto known = std::find_if(std::begin(markup), std::end(markup),
                                    [&](const auto& entry) { return entry.first == c; });
    known != std::end(markup) ? result.append(known->second) : result.append(1, c);
  }
  return result;
}

std::string fact_html(std::string_view name, std::string_view value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padding = i + k > bytes.size();
      result += padding ? '=' : letters[group >> (18 - 6 * k) & 63U];
    }
  }
  return result;
}

std::string data_uri(std::string_view media_type, const std::filesystem::path& path) {
  return fmt::format("data:{};base64,{}", media_type, base64(read_file(path)));
}

std::string inline_json(const nlohmann::ordered_json& data) {
  std::string text = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string policy_source(std::string_view sha256) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < sha256.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(sha256.substr(i, 2)), nullptr, 16));
  }
  return "'sha256-" + base64(bytes) + "'";
}

std::string size_text(std::uintmax_t bytes) {
  const auto count = static_cast<double>(bytes);
  if (count >= 1e6) return fmt::format("{:.1f} MB", count / 1e6);
  return fmt::format("{:.0f} kB", count / 1e3);
}

}  // namespace touchdown::render
