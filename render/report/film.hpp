#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchdown::render {

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

std::string film_html(const ReportFilm& film, const std::filesystem::path& run_directory);

}  // namespace touchdown::render
