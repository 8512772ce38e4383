#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "render/report/filmed_run.hpp"

namespace touchdown::render {

/// Only this much of a longer run is in the report's film (s), because the page contains it.
inline constexpr double longest_report_film = 20.0;

/// The report's small film of up to two runs beside each other, and a picture of it.
struct ReportFilm {
  std::filesystem::path video, picture;
};
ReportFilm report_film(const std::filesystem::path& run_directory);

/// Writes a film of each run, and the report's, into the run directory's `videos`. Views are
/// painted once for both. Errors: as `render_films`; `Stopped`.
void film_runs(const std::vector<FilmedRun>& runs, const std::filesystem::path& run_directory,
               int workers, const std::atomic<bool>* stop);

/// Writes the report's film with the same bytes, unless the run directory has one that is newer
/// than its recordings and models.
void film_for_report(const std::vector<FilmedRun>& runs, const std::filesystem::path& run_directory,
                     int workers, const std::atomic<bool>* stop);

}  // namespace touchdown::render
