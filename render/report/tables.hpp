#pragma once

#include <cstddef>
#include <string>

#include "experiments/results/text_tables.hpp"
#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// The table as HTML, with its caption. The first `text_columns` name the row.
std::string table_html(const experiments::CaptionedTable& table, std::size_t text_columns);

/// Every CSV table of the run directory in readable form: columns `x`, `x_low`, `x_high` are
/// merged.
ReportSection more_tables_section(const ReportSubject& subject);

}  // namespace touchdown::render
