#include "render/closed_loop/survival_figure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/tables/verbs.hpp"
#include "experiments/odometry/contact_sources.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/gnuplot/text.hpp"
#include "render/palette.hpp"
#include "render/report/tables.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

using Points = std::vector<SurvivalPoint>;

std::string title_of(const SurvivalPoint& point) {
  return fmt::format("Closed-loop results by contact source: {}, {}, {} sensors", point.scene,
                     point.law == "soft_landing" ? "soft landing" : point.law, point.sensors);
}

/// The alternative text: each row of the data.
std::string described(const Points& points) {
  std::string text = "Share of runs that finish.";
  for (const SurvivalPoint& point : points) {
    fmt::format_to(std::back_inserter(text), " {}, {}{}: {:.2f};",
                   simulators::simulator_title(point.simulator),
                   experiments::contact_title(point.contact),
                   point.varied.empty() ? "" : fmt::format(", {} {:g}", point.varied, point.at),
                   point.finished.estimate);
  }
  text.back() = '.';
  return text;
}

/// The look of a contact source's curve: the truth is dark, "always contact" grey, and each
/// estimator has its own colour.
struct CurveStyle {
  std::string colour;
  const char* line;
};

CurveStyle style_of(const std::string& contact, const std::vector<std::string>& estimators) {
  const auto colour = [](unsigned rgb) { return fmt::format("lc rgb '#{:06x}'", rgb); };
  if (contact == "truth") return {colour(truth_colour), "lw 2.4 dt 1 pt 7"};
  if (contact == "always") return {colour(always_contact_colour), "lw 2.4 dt 2 pt 6"};
  const std::size_t line_type = line_type_of(estimators, contact);
  return {fmt::format("lt {}", line_type),
          line_type <= 6 ? "lw 1.8 dt 1 pt 7" : "lw 1.8 dt 3 pt 5"};
}

std::string axis_of(const std::string& varied) {
  static const std::map<std::string, std::string> titles = {
      {"rise", "height of a step (m)"},
      {"delay", "delay of contact feedback (ms)"},
      {"noise", "torque noise (N·m)"},
      {"velocity", "commanded speed (m/s)"}};
  const auto title = titles.find(varied);
  return title == titles.end() ? varied : title->second;
}

constexpr double panel_side = 300.0, lower_height = 130.0, panel_gap = 34.0, axis_margin = 66.0;
constexpr double key_width = 200.0, between = 44.0;

/// A curve per contact source over the varied quantity.
Figure draw_curves(const Points& points, const std::vector<std::string>& estimators, double level,
                   const std::filesystem::path& stem) {
  const std::vector<std::string> engines = unique(points, &SurvivalPoint::simulator);
  const std::vector<std::string> contacts = unique(points, &SurvivalPoint::contact);
  const auto panels = static_cast<double>(engines.size());
  const FigureFrame frame(
      title_of(points.front()),
      fmt::format("{} runs per point, with the same initial conditions for all contact sources. "
                  "Bars: exact {:.0f} % intervals of the share of runs that finish; curves are "
                  "shifted sideways a little. Below: root mean square speed of the tyres over the "
                  "ground at landings. Oracles read the simulator's state.",
                  points.front().runs, 100.0 * level),
      axis_margin + panels * panel_side + (panels - 1.0) * panel_gap + key_width,
      24.0 + panel_side + between + lower_height + 52.0);
  double low = points.front().at, high = low, fastest = 0.0;
  for (const SurvivalPoint& point : points) {
    low = std::min(low, point.at);
    high = std::max(high, point.at);
    fastest = std::fmax(fastest, point.landing_speed);
  }
  const double span = high - low;
  const std::string file = gnuplot_text(stem.filename().string() + ".dat");
  std::string data = "#at\tfinished\tlow\thigh\tlanding_speed_mps\n";
  std::string commands = fmt::format("set bars 0\nset xrange [{}:{}]\n", number(low - 0.06 * span),
                                     number(high + 0.06 * span));
  std::size_t block = 0;
  for (std::size_t e = 0; e < engines.size(); ++e) {
    std::string upper, lower;
    for (std::size_t c = 0; c < contacts.size(); ++c, ++block) {
      const double aside =
          0.012 * span * (static_cast<double>(c) - 0.5 * static_cast<double>(contacts.size() - 1));
      for (const SurvivalPoint& point : points) {
        if (point.simulator != engines[e] || point.contact != contacts[c]) continue;
        fmt::format_to(std::back_inserter(data), "{}\t{}\t{}\t{}\t{}\n", number(point.at + aside),
                       number(point.finished.estimate), number(point.finished.low),
                       number(point.finished.high), number(point.landing_speed));
      }
      data += "\n\n";
      const CurveStyle style = style_of(contacts[c], estimators);
      const char* comma = c > 0 ? ", \\\n     " : "";
      upper += fmt::format(
          "{0}{1} index {2} using 1:2:3:4 with yerrorbars {3} lw 0.8 dt 1 pt 0 notitle, {1} index "
          "{2} using 1:2 with linespoints {3} {4} ps 0.7 title {5}",
          comma, file, block, style.colour, style.line,
          gnuplot_text(experiments::contact_title(contacts[c])));
      lower += fmt::format("{}{} index {} using 1:5 with linespoints {} {} ps 0.6 notitle", comma,
                           file, block, style.colour, style.line);
    }
    const double left = axis_margin + static_cast<double>(e) * (panel_side + panel_gap);
    commands += frame.panel(left, 24.0, panel_side, panel_side);
    commands += fmt::format(
        "set title {} offset 0,-0.6\nset yrange [-0.02:1.02]\nset ytics 0.2\nset format y '{}'\n"
        "unset xlabel\nset ylabel {}\n",
        gnuplot_text(std::string(simulators::simulator_title(engines[e]))), e == 0 ? "%g" : "",
        e == 0 ? "'share of runs that finish'" : "''");
    commands +=
        e == 0 ? fmt::format("set key at screen {}, screen {} left top Left reverse\n",
                             1.0 - (key_width - 20.0) / frame.width(), 1.0 - 66.0 / frame.height())
               : std::string("unset key\n");
    commands += "plot " + upper + '\n' + FigureFrame::end_panel();
    commands += frame.panel(left, 24.0 + panel_side + between, panel_side, lower_height);
    commands += fmt::format(
        "unset title\nunset key\nset yrange [0:{}]\nset ytics autofreq\nset format y '{}'\n"
        "set xlabel {}\nset ylabel {}\nplot {}\n",
        number(1.08 * std::max(fastest, 0.1)), e == 0 ? "%g" : "",
        gnuplot_text(axis_of(points.front().varied)), e == 0 ? "'landing speed (m/s)'" : "''",
        lower);
    commands += FigureFrame::end_panel();
  }
  return frame.draw(stem, commands, data, described(points));
}

struct Measure {
  double (*value)(const SurvivalPoint& point);
  const char* title;
  const char* columns;
  const char* range;
};
constexpr Measure measures[] = {{[](const SurvivalPoint& point) { return point.finished.estimate; },
                                 "share of runs that finish", "1:5:2:3", "[-0.02:1.02]"},
                                {[](const SurvivalPoint& point) { return point.landing_speed; },
                                 "tyre speed at landings (m/s)", "4:5:4:4", "[0:*]"},
                                {[](const SurvivalPoint& point) { return point.false_takeoffs; },
                                 "false takeoffs per minute of contact", "6:5:6:6", "[0:*]"}};
constexpr double row_height = 27.0, names_width = 190.0, measure_width = 250.0;

/// The measures that have values: without takeoffs there are no landings.
std::vector<Measure> measures_of(const Points& points) {
  std::vector<Measure> known;
  for (const Measure& measure : measures) {
    if (std::any_of(points.begin(), points.end(), [&](const SurvivalPoint& point) {
          return std::isfinite(measure.value(point));
        })) {
      known.push_back(measure);
    }
  }
  return known;
}

/// A row per contact source.
Figure draw_rows(const Points& points, double level, const std::filesystem::path& stem) {
  const std::vector<std::string> engines = unique(points, &SurvivalPoint::simulator);
  const std::vector<std::string> contacts = unique(points, &SurvivalPoint::contact);
  const std::vector<Measure> shown = measures_of(points);
  const double height = row_height * static_cast<double>(contacts.size());
  const FigureFrame frame(
      title_of(points.front()),
      fmt::format("{} runs, with the same initial conditions for all contact sources; exact "
                  "{:.0f} % intervals of the share of runs that finish; root mean square speed of "
                  "the tyres over the ground at landings. Oracles read the simulator's state.",
                  points.front().runs, 100.0 * level),
      names_width + static_cast<double>(shown.size()) * (measure_width + panel_gap), height + 96.0);
  std::vector<std::string> titles;
  for (const std::string& contact : contacts) {
    titles.push_back(experiments::contact_title(contact));
  }
  const std::string file = gnuplot_text(stem.filename().string() + ".dat");
  std::string data = "#finished\tlow\thigh\tlanding_speed_mps\theight\tfalse_takeoffs_per_minute\n";
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const double offset = 0.14 * (1.0 - 2.0 * static_cast<double>(e));
    for (const SurvivalPoint& point : points) {
      if (point.simulator != engines[e]) continue;
      const auto place = std::find(contacts.begin(), contacts.end(), point.contact);
      fmt::format_to(
          std::back_inserter(data), "{}\t{}\t{}\t{}\t{}\t{}\n", number(point.finished.estimate),
          number(point.finished.low), number(point.finished.high), number(point.landing_speed),
          static_cast<double>(contacts.end() - place - 1) + offset, number(point.false_takeoffs));
    }
    data += "\n\n";
  }
  std::string commands = "set grid noytics\nset border 1\nset xtics nomirror\n";
  for (std::size_t m = 0; m < shown.size(); ++m) {
    commands += frame.panel(names_width + static_cast<double>(m) * (measure_width + panel_gap),
                            24.0, measure_width, height);
    commands += fmt::format(
        "set yrange [-0.6:{}]\nset xrange {}\nset xlabel {}\n{}\n{}\nplot ",
        static_cast<double>(contacts.size()) - 0.4, shown[m].range, gnuplot_text(shown[m].title),
        m == 0 ? fmt::format("set ytics scale 0 ({})", row_tics(titles))
               : std::string("unset ytics"),
        m == 0 ? fmt::format("set key at graph -0.08, graph {:.3f} right bottom", -62.0 / height)
               : std::string("unset key"));
    for (std::size_t e = 0; e < engines.size(); ++e) {
      commands += fmt::format(
          "{}{} index {} using {} with xerrorbars lt {} lw 1.6 dt 1 pt 7 ps "
          "0.8 title {}",
          e > 0 ? ", " : "", file, e, shown[m].columns, e + 1,
          gnuplot_text(std::string(simulators::simulator_title(engines[e]))));
    }
    commands += '\n';
    commands += FigureFrame::end_panel();
  }
  return frame.draw(stem, commands, data, described(points));
}

}  // namespace

std::vector<SurvivalPoint> survival_points(const std::filesystem::path& run_directory) {
  const std::filesystem::path file = run_directory / "tables" / "survival.csv";
  if (!std::filesystem::exists(file)) return {};
  const Table table = from_csv(read_file(file));
  Points points;
  for (const std::vector<std::string>& row : table.rows) {
    const auto text = [&](const char* column) { return cell(table, row, column); };
    const auto value = [&](const char* column) { return number(text(column)); };
    const std::string varied = text("varied");
    points.push_back(
        {.simulator = text("simulator"),
         .scene = text("scenario"),
         .law = text("policy"),
         .contact = text("contact"),
         .varied = varied,
         .at = value(varied == "delay"   ? "delay_ms"
                     : varied == "noise" ? "torque_noise_nm"
                                         : "value"),
         .runs = static_cast<int>(value("runs")),
         .finished = {value("finished"), value("finished_low"), value("finished_high")},
         .landing_speed = value("landing_speed_rms_mps"),
         .false_takeoffs = value("false_takeoffs_per_minute"),
         .sensors = text("sensors")});
  }
  return points;
}

Figure draw_survival_figure(const std::vector<SurvivalPoint>& points,
                            const std::vector<std::string>& estimators, double level,
                            const std::filesystem::path& stem) {
  return points.front().varied.empty() ? draw_rows(points, level, stem)
                                       : draw_curves(points, estimators, level, stem);
}

void draw_survival_figures(const std::filesystem::path& run_directory,
                           const std::vector<std::string>& estimators, double level) {
  std::map<std::string, Points> figures;
  for (SurvivalPoint& point : survival_points(run_directory)) {
    std::string name = fmt::format("survival_{}_{}", point.scene, point.law);
    if (!point.varied.empty()) name += "_" + point.varied;
    figures[name].push_back(std::move(point));
  }
  for (const auto& [name, points] : figures) {
    draw_survival_figure(points, estimators, level, run_directory / "figures" / name);
  }
}

}  // namespace touchdown::render
