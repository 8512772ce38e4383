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

/// What a cell says when it is pointed at.
std::string words(const SceneScore& score) {
  return fmt::format(
      "{} [{}, {}]; F1 of flights {}, {} extra switches and {} false takeoffs per minute, takeoffs "
      "{} ms off",
      short_number(score.accuracy.estimate), short_number(score.accuracy.low),
      short_number(score.accuracy.high), short_number(score.flight_f1),
      short_number(score.extra_switches_per_minute), short_number(score.false_takeoffs_per_minute),
      short_number(score.takeoff_latency_median_ms));
}

/// The darker, the worse.
std::size_t level_of(double accuracy) {
  constexpr std::array limits = {0.6, 0.8, 0.9, 0.95, 0.98};
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), accuracy) -
                                  limits.begin());
}

struct ShareCell {
  double value = nothing;
  std::string words = {};
};

/// Estimators down. The best of a column is set in bold.
std::string share_table(const std::string& caption, const std::vector<std::string>& columns,
                        const std::vector<std::string>& estimators,
                        const std::vector<std::vector<ShareCell>>& cells) {
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
      const ShareCell& cell = cells[row][column];
      if (std::isnan(cell.value)) {
        html += "<td>–</td>";
        continue;
      }
      double best = 0.0;
      for (const auto& other : cells) best = std::fmax(best, other[column].value);
      html += fmt::format("<td class=\"level-{}{}\" data-value=\"{}\" title=\"{}\">{:.3f}</td>",
                          level_of(cell.value), cell.value >= best - 0.0005 ? " best" : "",
                          cell.value, escaped(cell.words), cell.value);
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
  std::vector<std::vector<ShareCell>> cells(estimators.size());
  for (std::size_t row = 0; row < estimators.size(); ++row) {
    for (const std::string& column : columns) {
      const auto found = std::find_if(scores.begin(), scores.end(), [&](const SceneScore& score) {
        return score.estimator == estimators[row] && name_of(score) == column;
      });
      cells[row].push_back(
          found == scores.end() ? ShareCell{} : ShareCell{found->accuracy.estimate, words(*found)});
    }
  }
  return share_table(caption, columns, estimators, cells);
}

}  // namespace

std::string matrix_html(const BenchmarkScores& scores) {
  const auto estimators = names(scores.standings, [](const Standing& p) { return p.estimator; });
  const auto settings = names(scores.standings, [](const Standing& p) { return p.setting; });
  std::string html;
  for (const std::string& noise :
       names(scores.standings, [](const Standing& p) { return p.noise; })) {
    std::vector<std::vector<ShareCell>> cells(estimators.size(),
                                              std::vector<ShareCell>(settings.size()));
    for (const Standing& place : scores.standings) {
      if (place.noise != noise) continue;
      const auto index = [](const std::vector<std::string>& all, const std::string& one) {
        return static_cast<std::size_t>(std::find(all.begin(), all.end(), one) - all.begin());
      };
      cells[index(estimators, place.estimator)][index(settings, place.setting)] = {
          place.mean.estimate,
          fmt::format("{} [{}, {}]; the worst, {}, in {} in {}", short_number(place.mean.estimate),
                      short_number(place.mean.low), short_number(place.mean.high),
                      short_number(place.worst), place.worst_scene,
                      simulators::simulator_title(place.worst_simulator))};
    }
    html += share_table(
        fmt::format("Mean over all scenes and engines, {}, on each robot with its sensors", noise),
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
      html += scene_table(
          alike, fmt::format("{}, {}, {}", simulators::simulator_title(simulator), setting, noise));
    }
  }
  return html;
}

}  // namespace touchdown::render
