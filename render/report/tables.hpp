#pragma once

#include <cstddef>
#include <string>

#include "experiments/results/paper.hpp"
#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// The number that a cell of a CSV table begins with; NaN where there is none.
double number(const std::string& cell);

/// The table with a caption; the first `text_columns` name the row.
std::string table_html(const experiments::CaptionedTable& table, std::size_t text_columns);

/// Every CSV table of the run directory, as people write it: columns `x`, `x_low`, `x_high` as one.
ReportSection more_tables_section(const ReportSubject& subject);

}  // namespace touchdown::render
