#include "render/report/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/tables/captions.hpp"
#include "render/report/tables.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// What one row of the table says of an estimator.
struct SceneScore {
  std::string simulator, setting, noise, scene, estimator;
  bool is_unseen = false;
  double accuracy = nothing;
  std::string words;  ///< the rest of it
};

std::string short_number(const std::string& cell) {
  const double value = number(cell);
  return std::isnan(value) ? "–" : fmt::format("{:.3g}", value);
}

std::vector<SceneScore> scores_in(const Table& table) {
  std::vector<SceneScore> scores;
  for (const auto& row : table.rows) {
    const auto cell = [&](const char* name) -> std::string {
      const auto found = std::find(table.header.begin(), table.header.end(), name);
      const auto column = static_cast<std::size_t>(found - table.header.begin());
      return column < row.size() ? row[column] : "nan";
    };
    const std::string fitted_on = cell("fitted_on");
    if (fitted_on != "own" && fitted_on != "nan") continue;
    scores.push_back(
        {cell("simulator"), fmt::format("{}, {} sensors", cell("robot"), cell("sensors")),
         fmt::format("{} N·m, {} m/s²", cell("torque_noise_nm"), cell("accelerometer_noise_mps2")),
         cell("scene"), cell("estimator"), cell("split") == "unseen",
         number(cell("balanced_accuracy")),
         fmt::format("{} [{}, {}]; F1 of flights {}, {} extra switches and {} false takeoffs per "
                     "minute, takeoffs {} ms off",
                     short_number(cell("balanced_accuracy")),
                     short_number(cell("balanced_accuracy_low")),
                     short_number(cell("balanced_accuracy_high")), short_number(cell("flight_f1")),
                     short_number(cell("extra_switches_per_minute")),
                     short_number(cell("false_takeoffs_per_minute")),
                     short_number(cell("takeoff_latency_median_ms")))});
  }
  return scores;
}

template <typename Name>
std::vector<std::string> names(const std::vector<SceneScore>& scores, const Name& name) {
  std::vector<std::string> all;
  for (const SceneScore& score : scores) {
    const std::string one = name(score);
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
  return all;
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

/// Means over all scenes and engines, one column per robot with its sensors.
std::string overview(const std::vector<SceneScore>& scores, const std::string& noise,
                     const std::vector<std::string>& estimators,
                     const std::vector<std::string>& settings) {
  std::vector<std::vector<ShareCell>> cells(estimators.size());
  for (std::size_t row = 0; row < estimators.size(); ++row) {
    for (const std::string& setting : settings) {
      double sum = 0.0;
      double worst = 1.0;
      int count = 0;
      for (const SceneScore& score : scores) {
        const bool counts = score.noise == noise && score.setting == setting &&
                            score.estimator == estimators[row] && !std::isnan(score.accuracy);
        if (!counts) continue;
        sum += score.accuracy;
        worst = std::fmin(worst, score.accuracy);
        ++count;
      }
      cells[row].push_back({count > 0 ? sum / count : nothing,
                            fmt::format("{} scenes and engines, the worst {:.3f}", count, worst)});
    }
  }
  return share_table(
      fmt::format("Mean over all scenes and engines, {}, on each robot with its sensors", noise),
      settings, estimators, cells);
}

std::string scene_table(const std::vector<SceneScore>& scores, const std::string& caption,
                        const std::vector<std::string>& estimators) {
  const auto columns = names(scores, [](const SceneScore& score) {
    return score.is_unseen ? score.scene + " *" : score.scene;
  });
  std::vector<std::vector<ShareCell>> cells(estimators.size());
  for (std::size_t row = 0; row < estimators.size(); ++row) {
    for (const std::string& column : columns) {
      const auto found = std::find_if(scores.begin(), scores.end(), [&](const SceneScore& score) {
        return score.estimator == estimators[row] &&
               (score.scene == column || score.scene + " *" == column);
      });
      cells[row].push_back(found == scores.end() ? ShareCell{}
                                                 : ShareCell{found->accuracy, found->words});
    }
  }
  return share_table(caption, columns, estimators, cells);
}

}  // namespace

ReportSection scenes_section(const ReportSubject& subject) {
  ReportSection section{"scenes", "Scene by scene", {}};
  const auto file = subject.directory / "tables" / "benchmark.csv";
  if (!subject.experiment.benchmark || !std::filesystem::exists(file)) return section;
  const std::vector<SceneScore> scores = scores_in(from_csv(read_file(file)));
  const auto estimators = names(scores, [](const SceneScore& s) { return s.estimator; });
  const auto settings = names(scores, [](const SceneScore& s) { return s.setting; });
  section.html =
      "<p>Balanced accuracy: the mean of the shares of contact and of flight that are told right; "
      "in "
      "a scene with one of the two, its share. The best of a column is bold, dark is bad, and 0.5 "
      "is "
      "what a constant answer earns where both happen. Scenes with a star are like none that "
      "anything was fitted to. A heading sorts; a cell says more.</p>\n";
  const auto noises = names(scores, [](const SceneScore& s) { return s.noise; });
  for (const std::string& noise : noises) {
    section.html += overview(scores, noise, estimators, settings);
  }
  for (const std::string& setting : settings) {
    std::string tables;
    for (const std::string& noise : noises) {
      for (const std::string& simulator : subject.experiment.simulators) {
        std::vector<SceneScore> alike;
        std::copy_if(scores.begin(), scores.end(), std::back_inserter(alike),
                     [&](const SceneScore& s) {
                       return s.setting == setting && s.noise == noise && s.simulator == simulator;
                     });
        if (alike.empty()) continue;
        tables += scene_table(
            alike,
            fmt::format("{}, {}, {}", simulators::simulator_title(simulator), setting, noise),
            estimators);
      }
    }
    section.html +=
        fmt::format("<details{}><summary>{}</summary>\n{}</details>\n",
                    setting == settings.front() ? " open" : "", escaped(setting), tables);
  }
  return section;
}

}  // namespace touchdown::render
