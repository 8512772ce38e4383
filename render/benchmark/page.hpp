#pragma once

#include <filesystem>

#include "render/report/subject.hpp"

namespace touchdown::render {

/// Writes `benchmark.html` into the run directory of an experiment with a benchmark, from its
/// tables and figures: the ranking, robots × sensors, every scene, a card for each estimator.
/// Returns the page.
std::filesystem::path write_benchmark_page(const ReportSubject& subject);

}  // namespace touchdown::render
