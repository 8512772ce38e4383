#include "render/odometry/errors_figure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/tables/verbs.hpp"
#include "experiments/odometry/contact_sources.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/gnuplot/text.hpp"
#include "render/report/tables.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr double row_height = 27.0, names_width = 200.0, panel_width = 330.0, gap_x = 26.0;

/// The contact sources by their mean error over scenes and engines, the best first.
std::vector<std::string> ranked(const std::vector<OdometryError>& errors) {
  std::vector<std::string> contacts = unique(errors, &OdometryError::contact);
  const auto sum = [&](const std::string& contact) {
    double all = 0.0;
    for (const OdometryError& error : errors) {
      if (error.contact == contact && !std::isnan(error.rms.estimate)) all += error.rms.estimate;
    }
    return all;
  };
  std::stable_sort(contacts.begin(), contacts.end(),
                   [&](const auto& a, const auto& b) { return sum(a) < sum(b); });
  return contacts;
}

std::string described(const std::vector<OdometryError>& errors) {
  std::string text = "Root mean square error of odometry.";
  for (const OdometryError& error : errors) {
    fmt::format_to(std::back_inserter(text), " {}, {}, {}: {:.3f} m;", error.scene,
                   simulators::simulator_title(error.simulator),
                   experiments::contact_title(error.contact), error.rms.estimate);
  }
  text.back() = '.';
  return text;
}

}  // namespace

std::vector<OdometryError> odometry_errors(const std::filesystem::path& run_directory) {
  const std::filesystem::path file = run_directory / "tables" / "odometry.csv";
  if (!std::filesystem::exists(file)) return {};
  const Table table = from_csv(read_file(file));
  std::vector<OdometryError> errors;
  for (const std::vector<std::string>& row : table.rows) {
    const auto text = [&](const char* column) { return cell(table, row, column); };
    errors.push_back(
        {text("simulator"),
         text("scenario"),
         text("contact"),
         text("robot"),
         text("sensors"),
         {number(text("rms_m")), number(text("rms_m_low")), number(text("rms_m_high"))}});
  }
  return errors;
}

Figure draw_odometry_figure(const std::vector<OdometryError>& errors, double level,
                            const std::filesystem::path& stem) {
  const std::vector<std::string> contacts = ranked(errors);
  const std::vector<std::string> scenes = unique(errors, &OdometryError::scene);
  const std::vector<std::string> engines = unique(errors, &OdometryError::simulator);
  const double height = row_height * static_cast<double>(contacts.size());
  const FigureFrame frame(
      fmt::format("Odometry error by contact source: {}, {} sensors", errors.front().robot,
                  errors.front().sensors),
      fmt::format(
          "Root mean square error of the horizontal position along the run, starting from the true "
          "pose, with {:.0f} % bootstrap intervals over runs. All sources use the same filter and "
          "the same sensors. Oracles repeat the true contact, with or without a delay.",
          100.0 * level),
      names_width + static_cast<double>(scenes.size()) * (panel_width + gap_x), height + 96.0);
  std::vector<std::string> titles;
  for (const std::string& contact : contacts) {
    titles.push_back(experiments::contact_title(contact));
  }
  const std::string file = gnuplot_text(stem.filename().string() + ".dat");
  std::string data = "#rms\tlow\thigh\theight\n";
  std::string commands = "set grid noytics\nset border 1\nset xtics nomirror\n";
  std::size_t block = 0;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    commands += frame.panel(names_width + static_cast<double>(s) * (panel_width + gap_x), 24.0,
                            panel_width, height);
    commands += fmt::format(
        "set title {} offset 0,-0.6\nset yrange [-0.6:{}]\nset xrange [0:*]\nset xlabel 'RMS error "
        "(m)'\n{}\n{}\nplot ",
        gnuplot_text(scenes[s]), static_cast<double>(contacts.size()) - 0.4,
        s == 0 ? fmt::format("set ytics scale 0 ({})", row_tics(titles))
               : std::string("unset ytics"),
        s == 0 ? fmt::format("set key at graph -0.08, graph {:.3f} right bottom", -62.0 / height)
               : std::string("unset key"));
    for (std::size_t e = 0; e < engines.size(); ++e, ++block) {
      const double offset = 0.16 * (1.0 - 2.0 * static_cast<double>(e));
      for (const OdometryError& error : errors) {
        if (error.scene != scenes[s] || error.simulator != engines[e]) continue;
        const auto place = std::find(contacts.begin(), contacts.end(), error.contact);
        fmt::format_to(std::back_inserter(data), "{}\t{}\t{}\t{}\n", number(error.rms.estimate),
                       number(error.rms.low), number(error.rms.high),
                       static_cast<double>(contacts.end() - place - 1) + offset);
      }
      data += "\n\n";
      commands += fmt::format(
          "{}{} index {} using 1:4:2:3 with xerrorbars lt {} lw 1.6 dt 1 pt 7 ps 0.8 title {}",
          e > 0 ? ", " : "", file, block, e + 1,
          gnuplot_text(std::string(simulators::simulator_title(engines[e]))));
    }
    commands += '\n';
    commands += FigureFrame::end_panel();
  }
  return frame.draw(stem, commands, data, described(errors));
}

void draw_odometry_figures(const std::filesystem::path& run_directory, double level) {
  const auto stem_of = [](const OdometryError& error) {
    return fmt::format("odometry_{}_{}", error.robot, error.sensors);
  };
  for (const auto& [stem, errors] : group_by(odometry_errors(run_directory), stem_of)) {
    draw_odometry_figure(errors, level, run_directory / "figures" / stem);
  }
}

}  // namespace touchdown::render
