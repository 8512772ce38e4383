#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "experiments/estimator_registry.hpp"
#include "render/csv_file.hpp"
#include "render/html.hpp"
#include "render/report_parts.hpp"

namespace touchdown {
namespace {

/// The number in ink, its interval quieter.
std::string cell_html(const std::string& cell) {
  const std::size_t interval = cell.find(" [");
  if (interval == std::string::npos) return escaped(cell);
  return fmt::format("{} <span class=\"interval\">{}</span>", escaped(cell.substr(0, interval)),
                     escaped(cell.substr(interval + 1)));
}

bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+-eE") == std::string::npos;
}

std::string readable_cell(const std::string& name, const TableRow& row) {
  if (row.has(interval_column(name, "_low")) && row.has(interval_column(name, "_high"))) {
    return with_interval(row.interval(name), name.ends_with("_ms") ? 1 : 3);
  }
  const std::string& cell = row.text(name);
  if (cell == "nan") return "–";
  if (name.ends_with("simulator")) return engine_title(cell);
  if (name == "estimator" || name == "first" || name == "second") return estimator_title(cell);
  if (is_number(cell) && cell.find('.') != std::string::npos) {
    return fmt::format("{:.4g}", row.number(name));
  }
  return cell;
}

std::string readable_name(std::string name) {
  static const std::vector<std::pair<std::string, std::string>> units = {
      {"_nm", " (N·m)"}, {"_mps2", " (m/s²)"}, {"_ms", " (ms)"}, {"_s", " (s)"}};
  std::string unit;
  for (const auto& [ending, text] : units) {
    if (!name.ends_with(ending)) continue;
    name.resize(name.size() - ending.size());
    unit = text;
    break;
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + unit;
}

}  // namespace

std::string table_html(const CaptionedTable& captioned, std::size_t text_columns) {
  const Table& table = captioned.table;
  const std::size_t reference_column = static_cast<std::size_t>(
      std::find_if(table.header.begin(), table.header.end(),
                   [](const std::string& name) { return name.starts_with("paper"); }) -
      table.header.begin());
  std::string html = fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\"><table>\n"
      "<caption><span>{}</span></caption>\n<thead><tr>",
      escaped(captioned.label), escaped(captioned.caption));
  for (std::size_t c = 0; c < table.header.size(); ++c) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", c < text_columns ? " class=\"name\"" : "",
                        escaped(table.header[c]));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c + 1 == text_columns) {
        html += fmt::format("<th scope=\"row\" class=\"name\">{}</th>", escaped(row[c]));
      } else if (c < text_columns) {
        html += fmt::format("<td class=\"name\">{}</td>", escaped(row[c]));
      } else if (c == reference_column) {
        html += fmt::format("<td class=\"reference\">{}</td>", escaped(row[c]));
      } else {
        html += "<td>" + cell_html(row[c]) + "</td>";
      }
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

Table readable(const Table& table) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& name : table.header) {
    taken.insert(interval_column(name, "_low"));
    taken.insert(interval_column(name, "_high"));
  }
  for (const std::string& name : table.header) {
    if (!taken.contains(name)) names.push_back(name);
  }
  Table result;
  for (const std::string& name : names) result.header.push_back(readable_name(name));
  for (const TableRow& row : rows_of(table)) {
    result.rows.emplace_back();
    for (const std::string& name : names) result.rows.back().push_back(readable_cell(name, row));
  }
  return result;
}

std::string engine_title(const std::string& simulator) {
  if (simulator == "mujoco") return "MuJoCo";
  if (simulator == "bullet") return "Bullet";
  return simulator;
}

std::string estimator_title(const std::string& estimator) {
  for (const EstimatorEntry& entry : estimator_entries()) {
    if (entry.name == estimator) return entry.title;
  }
  return estimator;
}

}  // namespace touchdown
