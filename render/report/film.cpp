#include "render/report/film.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "render/report/html.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;

/// A jump goes here before the takeoff, so that one sees it coming (s).
constexpr double run_up = 0.4;
/// And the drop counts as shown until so long after the landing (s).
constexpr double follow_through = 0.4;

std::string drops_html(const ReportFlights& engine) {
  std::string html =
      fmt::format("<h3>{}: {} {}</h3>\n<ol>\n", escaped(engine.engine), engine.flights.size(),
                  engine.flights.size() == 1 ? "drop" : "drops");
  for (const ReportFlights::Span& flight : engine.flights) {
    html += fmt::format(
        "<li><button type=\"button\" class=\"drop\" data-seek=\"{:.3f}\" data-end=\"{:.3f}\" "
        "aria-label=\"Play the drop at {:.2f} seconds in {}\">{:.2f} s<small>{:.0f} ms in the air"
        "</small></button></li>\n",
        std::max(0.0, flight.takeoff - run_up), flight.landing + follow_through, flight.takeoff,
        escaped(engine.engine), flight.takeoff, 1e3 * (flight.landing - flight.takeoff));
  }
  return html + "</ol>\n";
}

}  // namespace

std::string film_html(const ReportFilm& film, const fs::path& directory) {
  std::string html = fmt::format(
      "<div class=\"film\">\n<figure><video controls muted playsinline preload=\"auto\" "
      "aria-label=\"{}\" poster=\"{}\" src=\"{}\"></video>\n<figcaption>{}",
      escaped(film.description), data_uri("image/jpeg", film.poster),
      data_uri("video/mp4", film.video), escaped(film.description));
  for (std::size_t i = 0; i < film.full_size.size(); ++i) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(directory / film.full_size[i], error);
    html += fmt::format(
        "{} <a href=\"{}\">{}</a>{}", i == 0 ? " In full size, beside this file:" : ",",
        escaped(film.full_size[i].generic_string()), escaped(film.full_size[i].filename().string()),
        error ? "" : " (" + size_text(bytes) + ")");
  }
  html += film.full_size.empty() ? "</figcaption></figure>\n" : ".</figcaption></figure>\n";
  html += "<div class=\"drops\">\n<p class=\"note\">Choose a drop to see it:</p>\n";
  for (const ReportFlights& engine : film.engines) html += drops_html(engine);
  return html + "</div>\n</div>\n";
}

}  // namespace touchdown::render
