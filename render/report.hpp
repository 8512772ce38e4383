#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchdown {

/// What one engine's robot did in a film of the report: its flights, to be jumped to.
struct ReportFlights {
  struct Span {
    double takeoff, landing;  ///< of the film (s)
  };
  std::string engine;
  std::vector<Span> flights;
};

/// A small video that the report carries inside, and the files in full size beside it.
struct ReportFilm {
  std::string description;  ///< for people who cannot see it
  std::filesystem::path video, poster;
  std::vector<ReportFlights> engines;
  std::vector<std::filesystem::path> full_size;  ///< relative to the run directory
};

/// Write `report.html` into an experiment's run directory: one file that opens without a network,
/// with everything inside that the directory's `manifest.json`, `config.yaml`, `tables/` and
/// `figures/` tell, and the films. What the directory lacks is left out. Returns the file.
/// Errors: `InputError` when it is no run directory or one of these files is broken; `Error` when
/// the report cannot be written.
std::filesystem::path write_report(const std::filesystem::path& run_directory,
                                   const std::vector<ReportFilm>& films);

}  // namespace touchdown
