#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/error_scale.hpp"
#include "render/figures/iso_lines.hpp"
#include "render/report/sections.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

using Rows = std::vector<experiments::CellSummary>;

/// A noise level that a study varies.
struct NoiseAxis {
  double noise::NoiseCell::*level;
  std::string label, unit, name;
};

/// The grid of two noise levels.
struct NoiseGrid {
  NoiseAxis x, y;
};

/// The distinct levels, ascending.
std::vector<double> levels(const Rows& rows, const NoiseAxis& axis) {
  std::set<double> values;
  for (const experiments::CellSummary& row : rows) values.insert(row.cell.*axis.level);
  return {values.begin(), values.end()};
}

template <typename Wanted>
Rows rows_that(const Wanted& wanted, const Rows& rows) {
  Rows found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found), wanted);
  return found;
}

bool is_among(const std::vector<double>& levels, double level) {
  return std::find(levels.begin(), levels.end(), level) != levels.end();
}

/// The text that a cell shows when the user chooses it.
std::string readout(const experiments::CellSummary& row, const NoiseGrid& grid) {
  const auto level = [&](const NoiseAxis& axis) {
    return fmt::format("{} {:.4g} {}", axis.name, row.cell.*axis.level, axis.unit);
  };
  std::string text = fmt::format("{}, {}: {}, {}: accuracy {}",
                                 simulators::simulator_title(row.condition.test_simulator),
                                 experiments::estimator_title(row.condition.estimator),
                                 level(grid.y), level(grid.x), with_interval(row.success));
  if (std::isfinite(row.always_contact)) {
    text += fmt::format("; always contact {:.3f}", row.always_contact);
  }
  return text + fmt::format("; error rate {} %", error_text(error_percent(row.success.estimate)));
}

/// A map of one estimator's error rates in one engine, as inline SVG. Cells show their numbers when
/// the user chooses them.
class ErrorMap {
 public:
  /// Keeps a reference to the grid.
  ErrorMap(const Rows& rows, const NoiseGrid& grid)
      : grid_(grid), x_(levels(rows, grid.x)), y_(levels(rows, grid.y)) {
    cells_.assign(y_.size(), std::vector<const experiments::CellSummary*>(x_.size(), nullptr));
    for (const experiments::CellSummary& row : rows) {
      cells_[place(y_, row.cell.*grid.y.level)][place(x_, row.cell.*grid.x.level)] = &row;
    }
  }

  std::string svg(const std::string& title) const {
    const int columns = static_cast<int>(x_.size()), rows = static_cast<int>(y_.size());
    std::string svg = fmt::format(
        "<div class=\"pan\"><svg class=\"map\" viewBox=\"0 0 {} {}\" data-columns=\"{}\" "
        "tabindex=\"0\" role=\"group\" aria-label=\"{}. Rows: {}; columns: {}. The arrow keys "
        "choose a cell.\">\n",
        left + columns * cell_width + 2, top + rows * cell_height + bottom, columns, escaped(title),
        escaped(grid_.y.label), escaped(grid_.x.label));
    std::string numbers;
    for (std::size_t r = 0; r < y_.size(); ++r) {
      const int y = top + (rows - 1 - static_cast<int>(r)) * cell_height;
      for (std::size_t c = 0; c < x_.size(); ++c) {
        const int x = left + static_cast<int>(c) * cell_width;
        svg += cell_svg(cells_[r][c], x, y);
        numbers += number_svg(cells_[r][c], x, y);
      }
      svg += tick(left - 16, y + cell_height / 2 + 4, y_[r]);
    }
    for (std::size_t c = 0; c < x_.size(); ++c) {
      svg += tick(left + static_cast<int>(c) * cell_width + cell_width / 2,
                  top + rows * cell_height + 16, x_[c]);
    }
    return fmt::format(
        "{}{}{}<text x=\"{}\" y=\"{}\">{}</text>\n"
        "<text transform=\"translate(14 {}) rotate(-90)\">{}</text>\n</svg></div>\n",
        svg, borders_svg(), numbers, left + columns * cell_width / 2,
        top + rows * cell_height + bottom - 8, escaped(grid_.x.label), top + rows * cell_height / 2,
        escaped(grid_.y.label));
  }

 private:
  static constexpr int cell_width = 54, cell_height = 40, left = 58, top = 4, bottom = 46;

  static std::size_t place(const std::vector<double>& levels, double level) {
    return static_cast<std::size_t>(std::find(levels.begin(), levels.end(), level) -
                                    levels.begin());
  }

  static std::string tick(int x, int y, double level) {
    return fmt::format("<text class=\"tick\" x=\"{}\" y=\"{}\">{:.4g}</text>\n", x, y, level);
  }

  static double value_of(const experiments::CellSummary* cell) {
    return cell != nullptr ? error_percent(cell->success.estimate)
                           : std::numeric_limits<double>::quiet_NaN();
  }

  MapColour colour_of(const experiments::CellSummary* cell) const {
    const double value = value_of(cell);
    return std::isfinite(value) ? error_colour(value) : MapColour{"#595959", false};
  }

  std::string cell_svg(const experiments::CellSummary* cell, int x, int y) const {
    const std::string text =
        escaped(cell != nullptr ? readout(*cell, grid_) : "not part of this study");
    std::string svg = fmt::format(
        "<g class=\"cell\" data-readout=\"{0}\"><title>{0}</title><rect x=\"{1}\" y=\"{2}\" "
        "width=\"{3}\" height=\"{4}\" fill=\"{5}\"/>",
        text, x, y, cell_width, cell_height, colour_of(cell).hex);
    if (cell != nullptr && cell->loses()) {
      svg += fmt::format("<path class=\"beaten\" d=\"M{} {}l{} {}\"/>", x + 3, y + cell_height - 3,
                         cell_width - 6, 6 - cell_height);
    }
    return svg + "</g>\n";
  }

  /// A cell's number, with an outline of the cell's colour that hides lines behind it.
  std::string number_svg(const experiments::CellSummary* cell, int x, int y) const {
    const double value = value_of(cell);
    const MapColour colour = colour_of(cell);
    return fmt::format("<text class=\"number {}\" x=\"{}\" y=\"{}\" stroke=\"{}\">{}</text>\n",
                       colour.light ? "on-light" : "on-dark", x + cell_width / 2,
                       y + cell_height / 2 + 4, colour.hex, error_text(value));
  }

  /// Lines between cells below and above each level, with their labels.
  std::string borders_svg() const {
    std::vector<std::vector<double>> values(cells_.size());
    for (std::size_t r = 0; r < cells_.size(); ++r) {
      std::transform(cells_[r].begin(), cells_[r].end(), std::back_inserter(values[r]), value_of);
    }
    const auto x = [](double column) { return left + (column + 0.5) * cell_width; };
    const auto y = [&](double row) {
      return top + (static_cast<double>(y_.size()) - row - 0.5) * cell_height;
    };
    constexpr CellSize size{cell_width, cell_height};
    std::string path, labels;
    for (const LevelBorder& border :
         level_borders(values, {error_levels.begin(), error_levels.end()}, size)) {
      for (const IsoLine& part : without_label(border, size)) {
        char move = 'M';
        for (const auto& [column, row] : part) {
          path += fmt::format("{}{:.1f} {:.1f}", move, x(column), y(row));
          move = 'L';
        }
      }
      if (!border.labelled) continue;
      const LabelPlace place = label_place(border);
      labels += fmt::format(
          "<text class=\"number level on-light\" stroke=\"#ffffff\" transform=\"translate({:.1f} "
          "{:.1f}){}\" y=\"3\">{}</text>\n",
          x(place.x), y(place.y), place.upright ? " rotate(-90)" : "", label_of(border));
    }
    if (path.empty()) return {};
    return fmt::format("<path class=\"iso-halo\" d=\"{0}\"/><path class=\"iso\" d=\"{0}\"/>\n{1}",
                       path, labels);
  }

  const NoiseGrid& grid_;
  std::vector<double> x_, y_;  ///< columns from the left, rows from the bottom
  std::vector<std::vector<const experiments::CellSummary*>> cells_;  ///< by row, then column
};

/// The colour scale.
std::string scale_svg() {
  constexpr int width = 420, steps = 60, left = 24;
  const auto x = [](double percent) {
    return left + width * std::log(percent / lowest_error) / std::log(highest_error / lowest_error);
  };
  std::string svg =
      "<svg class=\"scale\" viewBox=\"0 0 476 36\" role=\"img\" aria-label=\"Colour scale: "
      "bright is a low error rate, dark a high one.\">\n";
  for (int i = 0; i < steps; ++i) {
    const double percent = lowest_error * std::pow(highest_error / lowest_error, (i + 0.5) / steps);
    svg += fmt::format(
        "<rect x=\"{}\" y=\"2\" width=\"{:.1f}\" height=\"14\" fill=\"{}\" "
        "shape-rendering=\"crispEdges\"/>",
        left + i * width / steps, 1.0 * width / steps + 0.4, error_colour(percent).hex);
  }
  const auto tick = [&](double percent, const char* sign) {
    return fmt::format("<text x=\"{:.1f}\" y=\"30\">{}{} %</text>", x(percent), sign, percent);
  };
  svg += '\n' + tick(lowest_error, "≤ ");
  for (const double level : error_levels) svg += tick(level, "");
  return svg + tick(highest_error, "≥ ") + "\n</svg>\n";
}

/// One grid: a choice of estimators, a line for the numbers of a cell, a map per engine and
/// estimator.
std::string grid_html(const Rows& rows, const NoiseGrid& grid,
                      const std::vector<std::string>& simulators, const std::string& name) {
  const bool fine = levels(rows, grid.x).size() > 8;
  std::string choice = "<fieldset class=\"choice\"><legend>Estimator</legend>\n",
              maps = fmt::format("<div class=\"maps{}\">\n", fine ? " fine" : "");
  bool first = true;
  for (const std::string& estimator : scored_estimators(rows)) {
    if (estimator == experiments::always_contact_name) continue;
    const std::string title = experiments::estimator_title(estimator);
    choice += fmt::format("<label><input type=\"radio\" name=\"{}\" value=\"{}\"{}>{}</label>\n",
                          name, escaped(estimator), first ? " checked" : "", escaped(title));
    first = false;
    for (const std::string& simulator : simulators) {
      const Rows own = rows_that(
          [&](const experiments::CellSummary& row) {
            return row.condition.estimator == estimator &&
                   row.condition.test_simulator == simulator;
          },
          rows);
      if (own.empty()) continue;
      const std::string engine = simulators::simulator_title(simulator);
      maps += fmt::format(
          "<figure data-estimator=\"{}\"><figcaption>{}: {}</figcaption>\n{}</figure>\n",
          escaped(estimator), escaped(engine), escaped(title),
          ErrorMap(own, grid).svg(fmt::format("{}, {}: error rate", title, engine)));
    }
  }
  return fmt::format(
      "<div class=\"heatmaps\">\n{}</fieldset>\n<p class=\"readout\" aria-live=\"polite\">Point at "
      "a cell, tap it, or use the arrow keys: its numbers appear here.</p>\n{}{}</div>\n<p "
      "class=\"note\">Numbers are error rates in percent, the share of steps with a wrong "
      "decision: "
      "lower is better. The colour scale is logarithmic, ends at {} and {} %, and is the same in "
      "every map of every report. Lines run between cells below and above {} %. A struck-out cell "
      "does not beat always contact. The table “Accuracy” below lists the accuracies.</p>\n"
      "</div>\n",
      choice, scale_svg(), maps, lowest_error, highest_error, fmt::join(error_levels, ", "));
}

}  // namespace

ReportSection heatmap_section(const ReportSubject& subject) {
  ReportSection section{"noise", "Under sensor noise", {}};
  const noise::NoiseGridConfig& noise = subject.experiment.noise;
  const std::vector<std::string>& simulators = subject.experiment.simulators;
  // The other grid's diagonal may have levels that this grid lacks.
  const Rows alike = rows_that(
      [&](const experiments::CellSummary& row) { return is_among(noise.torque, row.cell.torque); },
      subject.summary.cells);
  const NoiseGrid torque_grid{
      {&noise::NoiseCell::accelerometer, "accelerometer noise (m/s²)", "m/s²",
       "accelerometer noise"},
      {&noise::NoiseCell::torque, "torque noise (N·m)", "N·m", "torque noise"}};
  if (levels(alike, torque_grid.x).size() * levels(alike, torque_grid.y).size() > 1) {
    section.html += grid_html(alike, torque_grid, simulators, "estimator");
  }
  const noise::KneeWheelGridConfig& joints = noise.knee_wheel;
  const Rows apart = rows_that(
      [&](const experiments::CellSummary& row) {
        return row.cell.accelerometer == joints.accelerometer &&
               is_among(joints.knee, row.cell.knee) && is_among(joints.wheel, row.cell.wheel);
      },
      subject.summary.cells);
  if (std::any_of(apart.begin(), apart.end(), [](const experiments::CellSummary& row) {
        return row.cell.knee != row.cell.wheel;
      })) {
    section.html += fmt::format(
        "<h3>Separate noise on knees and wheels</h3>\n<p>Accelerometer noise {:.4g} m/s².</p>\n",
        joints.accelerometer);
    section.html +=
        grid_html(apart,
                  {{&noise::NoiseCell::wheel, "wheel torque noise (N·m)", "N·m", "wheel noise"},
                   {&noise::NoiseCell::knee, "knee torque noise (N·m)", "N·m", "knee noise"}},
                  simulators, "estimator-apart");
  }
  return section;
}

}  // namespace touchdown::render
