#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Writes a page that needs no network: what its header says, a list of contents, and the sections
/// that say something.
void write_page(const ReportSubject& subject, const std::filesystem::path& path,
                const std::string& header_html, std::vector<ReportSection> sections);

}  // namespace touchdown::render
