#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Writes `report.html` into an experiment's run directory: one file that opens without a network.
/// It contains the contents of the directory's `manifest.json`, `config.yaml`, `tables/` and
/// `figures/`, the sections `of_runs` (films) and `of_studies`. Missing parts are left out. Returns
/// the file. Errors: `InputError` when one of these files is broken; `Error` when the report cannot
/// be written.
std::filesystem::path write_report(const ReportSubject& subject,
                                   const std::vector<ReportSection>& of_runs,
                                   const std::vector<ReportSection>& of_studies);

}  // namespace touchdown::render
