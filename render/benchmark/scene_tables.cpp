#include "render/benchmark/scene_tables.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "render/report/html.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::string short_number(double value) {
  return std::isnan(value) ? "–" : fmt::format("{:.3g}", value);
}

/// With the digits that the cells have.
std::string accuracy_text(double accuracy) {
  return std::isnan(accuracy) ? "–" : fmt::format("{:.3f}", accuracy);
}

std::string accuracy_text(const Interval& accuracy) {
  return fmt::format("balanced accuracy {} [{}, {}]", accuracy_text(accuracy.estimate),
                     accuracy_text(accuracy.low), accuracy_text(accuracy.high));
}

/// The text that a cell shows when the user points at it.
std::string tooltip(const SceneScore& score) {
  return fmt::format(
      "{}; flight F1 {}; {} extra switches per minute; {} false takeoffs per minute; median "
      "takeoff latency {} ms",
      accuracy_text(score.accuracy), short_number(score.flight_f1),
      short_number(score.extra_switches_per_minute), short_number(score.false_takeoffs_per_minute),
      short_number(score.takeoff_latency_median_ms));
}

/// The shade of a cell, from 0: the darkest and worst.
std::size_t level_of(double accuracy) {
  constexpr std::array limits = {0.6, 0.8, 0.9, 0.95, 0.98};
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), accuracy) -
                                  limits.begin());
}

struct AccuracyCell {
  double value = nothing;
  std::string tooltip = {};
};

/// A table with a row per estimator. The best of each column is bold.
std::string accuracy_table(const std::string& caption, const std::vector<std::string>& columns,
                           const std::vector<std::string>& estimators,
                           const std::vector<std::vector<AccuracyCell>>& cells) {
  std::string html = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\">\n<table "
      "class=\"shares\">\n<caption><span>{0}</span></caption>\n<thead><tr><th class=\"name\" "
      "scope=\"col\">estimator</th>",
      escaped(caption));
  for (const std::string& column : columns) {
    html +=
        fmt::format("<th scope=\"col\"><button class=\"sort\">{}</button></th>", escaped(column));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < estimators.size(); ++row) {
    html += fmt::format("<tr><th class=\"name\" scope=\"row\">{}</th>",
                        escaped(experiments::estimator_title(estimators[row])));
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const AccuracyCell& cell = cells[row][column];
      if (std::isnan(cell.value)) {
        html += "<td>–</td>";
        continue;
      }
      double best = 0.0;
      for (const auto& other : cells) best = std::fmax(best, other[column].value);
      html += fmt::format("<td class=\"level-{}{}\" data-value=\"{}\" title=\"{}\">{:.3f}</td>",
                          level_of(cell.value), cell.value >= best - 0.0005 ? " best" : "",
                          cell.value, escaped(cell.tooltip), cell.value);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string name_of(const SceneScore& score) {
  return score.is_unseen ? score.scene + " *" : score.scene;
}

std::string scene_table(const std::vector<SceneScore>& scores, const std::string& caption) {
  const auto estimators = names(scores, [](const SceneScore& s) { return s.estimator; });
  const auto columns = names(scores, name_of);
  std::vector<std::vector<AccuracyCell>> cells(estimators.size());
  for (std::size_t row = 0; row < estimators.size(); ++row) {
    for (const std::string& column : columns) {
      const auto found = std::find_if(scores.begin(), scores.end(), [&](const SceneScore& score) {
        return score.estimator == estimators[row] && name_of(score) == column;
      });
      cells[row].push_back(found == scores.end()
                               ? AccuracyCell{}
                               : AccuracyCell{found->accuracy.estimate, tooltip(*found)});
    }
  }
  return accuracy_table(caption, columns, estimators, cells);
}

}  // namespace

std::string matrix_html(const BenchmarkScores& scores) {
  const auto estimators = names(scores.standings, [](const Standing& p) { return p.estimator; });
  const auto settings = names(scores.standings, [](const Standing& p) { return p.setting; });
  std::string html;
  for (const std::string& noise :
       names(scores.standings, [](const Standing& p) { return p.noise; })) {
    std::vector<std::vector<AccuracyCell>> cells(estimators.size(),
                                                 std::vector<AccuracyCell>(settings.size()));
    for (const Standing& standing : scores.standings) {
      if (standing.noise != noise) continue;
      const auto index = [](const std::vector<std::string>& all, const std::string& one) {
        return static_cast<std::size_t>(std::find(all.begin(), all.end(), one) - all.begin());
      };
      cells[index(estimators, standing.estimator)][index(settings, standing.setting)] = {
          standing.mean.estimate,
          fmt::format("mean {}; worst scene: {} in {}, {}", accuracy_text(standing.mean),
                      accuracy_text(standing.worst), standing.worst_scene,
                      simulators::simulator_title(standing.worst_simulator))};
    }
    html += accuracy_table(
        fmt::format("Mean balanced accuracy over all scenes and engines, by robot and sensors, {}",
                    noise),
        settings, estimators, cells);
  }
  return html;
}

std::string scenes_html(const BenchmarkScores& scores, const std::string& setting,
                        const std::vector<std::string>& simulators) {
  std::string html;
  for (const std::string& noise : names(scores.scenes, [](const auto& s) { return s.noise; })) {
    for (const std::string& simulator : simulators) {
      std::vector<SceneScore> alike;
      std::copy_if(scores.scenes.begin(), scores.scenes.end(), std::back_inserter(alike),
                   [&](const SceneScore& s) {
                     return s.setting == setting && s.noise == noise && s.simulator == simulator;
                   });
      if (alike.empty()) continue;
      html +=
          scene_table(alike, fmt::format("Balanced accuracy by scene: {}, {}, {}",
                                         simulators::simulator_title(simulator), setting, noise));
    }
  }
  return html;
}

}  // namespace touchdown::render
