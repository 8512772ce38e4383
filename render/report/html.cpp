#include "render/report/html.hpp"

#include <cstdint>
#include <kainjow/mustache.hpp>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "report_assets.hpp"

namespace touchdown::render {

namespace {

namespace mustache = kainjow::mustache;

/// ", built from commit a1b2c3d4e5f6": the commit of the program that computed the numbers.
std::string built_from(const Json& manifest) {
  const auto versions = manifest.find("versions");
  if (versions == manifest.end() || !versions->is_object()) return {};
  const auto written = versions->find("commit");
  if (written == versions->end() || !written->is_string()) return {};
  const auto commit = written->get<std::string>();
  if (commit.empty()) return {};
  return commit.starts_with("unknown") ? " (commit " + commit + ")"
                                       : ", built from commit " + commit;
}

mustache::data data_of(const Json& value) {
  if (value.is_object()) {
    mustache::data object;
    for (const auto& [name, member] : value.items()) object[name] = data_of(member);
    return object;
  }
  if (value.is_array()) {
    mustache::data list(mustache::data::type::list);
    for (const Json& item : value) list.push_back(data_of(item));
    return list;
  }
  if (value.is_boolean()) return value.get<bool>();
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.empty()) return false;
  return text;
}

/// A name that a template has and its members lack is a mistake, not an empty text.
class Members : public mustache::context<std::string> {
 public:
  using context::context;
  const mustache::data* get(const std::string& name) const override {
    const mustache::data* const found = context::get(name);
    if (found == nullptr) throw Error(fmt::format("a page lacks '{}'", name));
    return found;
  }
};

}  // namespace

std::string html_of(std::string_view name, const Json& members) {
  mustache::data data = data_of(members);
  std::string text;
  for (const ReportTemplate& one : report_templates) {
    data.set(one.name, mustache::partial([&one] { return one.content; }));
    if (one.name == name) text = one.content;
  }
  Members context(&data);
  mustache::mustache page(text);
  std::string html = page.render(context);
  if (!page.is_valid()) throw Error(fmt::format("{}: {}", name, page.error_message()));
  // The line of a tag that shows nothing may stay.
  return html.find_first_not_of(" \n") == html.npos ? "" : html;
}

void write_page(const ReportSubject& subject, const std::filesystem::path& path,
                const PageHeader& header, const std::vector<ReportSection>& sections) {
  Json page = {{"name", subject.experiment.name},
               {"heading", header.heading},
               {"lead", header.lead},
               {"facts", Json::array()},
               {"note", header.note},
               {"is_benchmark", header.is_benchmark},
               {"sections", Json::array()},
               {"built_from", built_from(subject.manifest)},
               {"style", report_style.content},
               {"script", report_script.content},
               {"style_source", policy_source(report_style.sha256)},
               {"script_source", policy_source(report_script.sha256)}};
  for (const auto& [fact, value] : header.facts) {
    page["facts"].push_back({{"fact", fact}, {"value", value}});
  }
  for (const auto& [id, title, html] : sections) {
    if (html.empty()) continue;
    page["sections"].push_back({{"id", id}, {"title", title}, {"html", html}});
  }
  write_atomically(path, html_of("page.html", page));
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

std::string inline_json(const Json& data) {
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
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
