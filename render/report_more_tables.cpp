#include <algorithm>

#include <fmt/format.h>

#include "render/csv_file.hpp"
#include "render/html.hpp"
#include "render/report_parts.hpp"

namespace touchdown {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rows = 400;

bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+-eE") == std::string::npos;
}

std::string title_of(const fs::path& file) {
  std::string title = file.stem().string();
  std::replace(title.begin(), title.end(), '_', ' ');
  if (!title.empty() && title[0] >= 'a' && title[0] <= 'z')
    title[0] = static_cast<char>(title[0] - 32);
  return title;
}

}  // namespace

ReportSection more_tables_section(const ReportSubject& subject) {
  ReportSection section{"tables", "Every table", {}};
  std::error_code ignored;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(subject.directory / "tables", ignored)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    auto table = read_csv(file);
    if (!table || table->rows.empty()) continue;
    const std::size_t rows = table->rows.size();
    std::string caption = fmt::format("tables/{}, {} rows", file.filename().string(), rows);
    if (rows > most_rows) {
      table->rows.resize(most_rows);
      caption += fmt::format(", the first {} of them", most_rows);
    }
    const Table shown = readable(*table);
    std::size_t text_columns = 1;
    while (text_columns < shown.header.size() && !is_number(shown.rows[0][text_columns]) &&
           shown.rows[0][text_columns].find_first_of("0123456789") == std::string::npos) {
      ++text_columns;
    }
    section.html +=
        fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(title_of(file)),
                    table_html({caption, title_of(file), shown}, text_columns));
  }
  return section;
}

}  // namespace touchdown
