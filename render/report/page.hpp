#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Writes a page that needs no network: the header, a list of contents, and all sections that are
/// not empty.
void write_page(const ReportSubject& subject, const std::filesystem::path& path,
                const std::string& header_html, std::vector<ReportSection> sections);

}  // namespace touchdown::render
