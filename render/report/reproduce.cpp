#include "render/report/reproduce.hpp"

#include <fmt/format.h>

#include "render/report/tables.hpp"

namespace touchdown::render {
namespace {

std::string text_of(const nlohmann::ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.3g}", value.get<double>());
  return value.dump();
}

void add_rows(const nlohmann::ordered_json& manifest, const char* key, const std::string& prefix,
              Table& table) {
  if (!manifest.contains(key) || !manifest[key].is_object()) return;
  for (const auto& [name, value] : manifest[key].items()) {
    if (std::string(key) == "host" && name == "name") continue;
    std::string words = prefix + name;
    for (char& c : words) c = c == '_' ? ' ' : c;
    table.rows.push_back({words, text_of(value)});
  }
}

}  // namespace

ReportSection reproduce_section(const ReportSubject& subject) {
  const auto& manifest = subject.manifest;
  std::string html =
      "<p>One command computes everything on this page again, from the configuration that lies "
      "beside it; the same program gives the same numbers, to the last digit:</p>\n"
      "<pre><code>touchdown run config.yaml</code></pre>\n";
  if (manifest.contains("command") && manifest["command"].is_string()) {
    html += fmt::format("<p>This is what was typed:</p>\n<pre><code>{}</code></pre>\n",
                        escaped(manifest["command"].get<std::string>()));
  }
  Table table{{"what", "value"}, {}};
  for (const char* key : {"id", "finished_at"}) {
    if (manifest.contains(key)) table.rows.push_back({key, text_of(manifest[key])});
  }
  add_rows(manifest, "versions", "version: ", table);
  add_rows(manifest, "seeds", "seed: ", table);
  add_rows(manifest, "host", "", table);
  add_rows(manifest, "timings_s", "seconds to ", table);
  for (auto& row : table.rows) {
    for (char& c : row[0]) c = c == '_' ? ' ' : c;
  }
  html += table_html({"Versions, seeds and how long it took", "versions and seeds", table}, 1);
  if (manifest.contains("failed_runs") && manifest["failed_runs"].is_array() &&
      !manifest["failed_runs"].empty()) {
    Table failed{{"recording", "outcome"}, {}};
    for (const auto& run : manifest["failed_runs"]) {
      failed.rows.push_back({run.value("recording", ""), run.value("outcome", "")});
    }
    html += table_html({"Runs that are not scored", "failed runs", failed}, 1);
  }
  html += fmt::format(
      "<details><summary>The configuration, every default written out</summary>\n"
      "<pre tabindex=\"0\"><code>{}</code></pre></details>\n",
      escaped(subject.config_text));
  return {"reproduce", "Reproduce it", html};
}

}  // namespace touchdown::render
