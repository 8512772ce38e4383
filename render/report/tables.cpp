#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/results/captions.hpp"
#include "render/report/sections.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rows = 400;

bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+-eE") == std::string::npos;
}

std::string readable_cell(const std::string& name, const TableRow& row,
                          const experiments::Experiment& experiment) {
  std::string cell = row.text(name);
  if (cell == "nan") return "–";
  if (name.ends_with("simulator")) return simulators::simulator_title(cell);
  if (name == "estimator" || name == "first" || name == "second")
    return experiments::estimator_title_in(experiment, cell);
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
  if (name.ends_with("success")) name += " rate";  // the files' name is `success`
  return name + unit;
}

/// The table with columns `x`, `x_low`, `x_high` merged, and with readable names.
TextTable readable(const Table& table, const experiments::Experiment& experiment) {
  std::set<std::string> names, ends;
  for (const Column& column : table.columns) {
    names.insert(column.name);
    for (const char* end : {"_low", "_high"}) ends.insert(bound_name(column.name, end));
  }
  TextTable result{{}, std::vector<std::vector<std::string>>(table.rows.size())};
  for (const auto& [name, role, type, as] : table.columns) {
    if (ends.contains(name)) continue;
    result.header.push_back(readable_name(name));
    const bool has_interval =
        names.contains(bound_name(name, "_low")) && names.contains(bound_name(name, "_high"));
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const TableRow row(table, r);
      result.rows[r].push_back(
          has_interval ? with_interval(row.interval(name), name.ends_with("_ms") ? 1 : 3)
                       : readable_cell(name, row, experiment));
    }
  }
  return result;
}

std::string title_of(const fs::path& file) {
  std::string title = file.stem().string();
  std::replace(title.begin(), title.end(), '_', ' ');
  if (!title.empty() && title[0] >= 'a' && title[0] <= 'z')
    title[0] = static_cast<char>(title[0] - 32);
  return title;
}

}  // namespace

Json table_members(const experiments::CaptionedTable& captioned, std::size_t text_columns) {
  const TextTable& table = captioned.table;
  const std::size_t reference_column = static_cast<std::size_t>(
      std::find_if(table.header.begin(), table.header.end(),
                   [](const std::string& name) { return name.starts_with("paper"); }) -
      table.header.begin());
  Json header = Json::array();
  for (std::size_t c = 0; c < table.header.size(); ++c) {
    header.push_back({{"text", table.header[c]}, {"is_name", c < text_columns}});
  }
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (std::size_t c = 0; c < row.size(); ++c) {
      const bool is_name = c < text_columns, is_reference = c == reference_column;
      // The page shows the interval of an own number in a lighter colour.
      const std::size_t end = is_name || is_reference ? row[c].npos : row[c].find(" [");
      cells.push_back({{"is_title", c + 1 == text_columns},
                       {"class", is_name        ? "name"
                                 : is_reference ? "reference"
                                                : ""},
                       {"text", row[c].substr(0, end)},
                       {"interval", end == row[c].npos ? "" : row[c].substr(end + 1)}});
    }
    rows.push_back({{"cells", std::move(cells)}});
  }
  return {{"label", captioned.label},
          {"caption", captioned.caption},
          {"header", std::move(header)},
          {"rows", std::move(rows)}};
}

ReportSection more_tables_section(const ReportSubject& subject) {
  std::error_code ignored;
  std::vector<fs::path> files;
  for (const fs::path& entry : entries_in(subject.directory / "tables")) {
    if (entry.extension() == ".csv" && fs::is_regular_file(entry, ignored)) files.push_back(entry);
  }
  Json tables = Json::array();
  for (const fs::path& file : files) {
    Table table = table_of(from_csv(read_file(file)));
    const std::size_t rows = table.rows.size();
    if (rows == 0) continue;
    std::string caption = fmt::format("tables/{}, {} rows", file.filename().string(), rows);
    if (rows > most_rows) {
      table.rows.resize(most_rows);
      caption += fmt::format(", the first {} of them", most_rows);
    }
    const TextTable shown = readable(table, subject.experiment);
    std::size_t text_columns = 1;
    while (text_columns < shown.header.size() && !is_number(shown.rows[0][text_columns]) &&
           shown.rows[0][text_columns].find_first_of("0123456789") == std::string::npos) {
      ++text_columns;
    }
    tables.push_back(table_members({caption, title_of(file), shown}, text_columns));
  }
  return {"tables", "Every table", html_of("tables.html", {{"tables", std::move(tables)}})};
}

}  // namespace touchdown::render
