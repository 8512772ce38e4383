#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "render/report/sections.hpp"
#include "render/studies/benchmark.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

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

std::string tooltip(const TableRow& score) {
  return fmt::format(
      "F1 of events {}; {} extra switches per minute; {} s of long errors per minute; median "
      "latency of takeoffs {} ms, of landings {} ms; precision of air {}; {}",
      short_number(score.number("event_f1")),
      short_number(score.number("extra_switches_per_minute")),
      short_number(score.number("long_errors_s_per_minute")),
      short_number(score.number("takeoff_latency_median_ms")),
      short_number(score.number("landing_latency_median_ms")),
      short_number(score.number("no_contact_precision")),
      accuracy_text(score.interval("balanced_accuracy")));
}

/// The shade of a cell, from 0: the darkest and worst.
std::size_t level_of(double accuracy) {
  constexpr std::array limits = {0.6, 0.8, 0.9, 0.95, 0.98};
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), accuracy) -
                                  limits.begin());
}

using Estimators = std::vector<experiments::EstimatorEntry>;

struct AccuracyCell {
  double value = nothing;
  std::string tooltip = {};
};

/// The members of `accuracy_table.html`: a row per estimator. The best of each column is bold.
Json accuracy_table(const Estimators& external, const std::string& caption,
                    const std::vector<std::string>& columns,
                    const std::vector<std::string>& estimators,
                    const std::vector<std::vector<AccuracyCell>>& cells) {
  Json rows = Json::array();
  for (std::size_t row = 0; row < estimators.size(); ++row) {
    Json of_row = Json::array();
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const auto& [value, tooltip] = cells[row][column];
      if (std::isnan(value)) {
        of_row.push_back({{"text", ""}});
        continue;
      }
      double best = 0.0;
      for (const auto& other : cells) best = std::fmax(best, other[column].value);
      of_row.push_back({{"text", accuracy_text(value)},
                        {"level", level_of(value)},
                        {"is_best", value >= best - 0.0005},
                        {"value", fmt::format("{}", value)},
                        {"tooltip", tooltip}});
    }
    rows.push_back({{"title", experiments::estimator_title(estimators[row], external)},
                    {"cells", std::move(of_row)}});
  }
  return {{"caption", caption}, {"columns", columns}, {"rows", std::move(rows)}};
}

double accuracy_of(const TableRow& score) { return score.number("balanced_accuracy"); }

/// No estimator was fitted to scenes like one with a star.
std::string name_of(const TableRow& score) {
  return score.text("scene") + (score.text("split") == "unseen" ? " *" : "");
}

Json scene_table(const Estimators& external, const std::vector<TableRow>& scores,
                 const std::string& caption) {
  const auto estimators = unique(scores, estimator_of);
  const auto columns = unique(scores, name_of);
  std::vector<std::vector<AccuracyCell>> cells(estimators.size());
  for (std::size_t row = 0; row < estimators.size(); ++row) {
    for (const std::string& column : columns) {
      const auto found = std::find_if(scores.begin(), scores.end(), [&](const TableRow& score) {
        return estimator_of(score) == estimators[row] && name_of(score) == column;
      });
      cells[row].push_back(found == scores.end()
                               ? AccuracyCell{}
                               : AccuracyCell{accuracy_of(*found), tooltip(*found)});
    }
  }
  return accuracy_table(external, caption, columns, estimators, cells);
}

/// Mean balanced accuracy over all scenes and engines: a table for every noise setting, with a row
/// per estimator and a column per robot with its sensors.
std::string matrix_html(const BenchmarkTables& tables) {
  const std::vector<TableRow> standings = tables.standings.all();
  const auto estimators = unique(standings, estimator_of);
  const auto settings = unique(standings, setting_of);
  Json of_noise = Json::array();
  for (const std::string& noise : unique(standings, noise_of)) {
    std::vector<std::vector<AccuracyCell>> cells(estimators.size(),
                                                 std::vector<AccuracyCell>(settings.size()));
    for (const TableRow& standing : standings) {
      if (noise_of(standing) != noise) continue;
      const auto index = [](const std::vector<std::string>& all, const std::string& one) {
        return static_cast<std::size_t>(std::find(all.begin(), all.end(), one) - all.begin());
      };
      cells[index(estimators, estimator_of(standing))][index(settings, setting_of(standing))] = {
          mean_of(standing),
          fmt::format("mean {}; worst scene: {} in {}, {}",
                      accuracy_text(standing.interval("mean_balanced_accuracy")),
                      accuracy_text(standing.number("worst_balanced_accuracy")),
                      standing.text("worst_scene"),
                      simulators::simulator_title(standing.text("worst_simulator")))};
    }
    of_noise.push_back(accuracy_table(
        tables.external,
        fmt::format("Mean balanced accuracy over all scenes and engines, by robot and sensors, {}",
                    noise),
        settings, estimators, cells));
  }
  return html_of("benchmark_matrix.html", {{"tables", std::move(of_noise)}});
}

/// Balanced accuracy by scene for one robot with its sensors: a table for every engine and noise
/// setting, with a row per estimator and a column per scene. A star marks scenes that no estimator
/// was fitted to.
Json scene_tables(const BenchmarkTables& tables, const std::string& setting,
                  const std::vector<std::string>& simulators) {
  const std::vector<TableRow> scores = tables.scenes.all();
  Json of_engines = Json::array();
  for (const std::string& noise : unique(scores, noise_of)) {
    for (const std::string& simulator : simulators) {
      const std::vector<TableRow> alike = where(scores, [&](const TableRow& score) {
        return setting_of(score) == setting && noise_of(score) == noise &&
               score.text("simulator") == simulator;
      });
      if (alike.empty()) continue;
      of_engines.push_back(
          scene_table(tables.external, alike,
                      fmt::format("Balanced accuracy by scene: {}, {}, {}",
                                  simulators::simulator_title(simulator), setting, noise)));
    }
  }
  return of_engines;
}

constexpr std::size_t most_failures = 4;  ///< scenes on a card
constexpr double failure = 0.95;          ///< a card lists scenes of lower balanced accuracy

std::string summary_of(const std::string& estimator, const Estimators& external) {
  const auto* const entry = experiments::find_estimator(estimator, external);
  return entry == nullptr ? "Submitted as beliefs" : entry->summary;
}

/// The errors in a scene, of both kinds: missed flight and false flight.
std::string errors_of(const TableRow& score) {
  const double missed = 1.0 - score.number("no_contact_recall");
  const double is_contact = 1.0 - score.number("no_contact_precision");
  if (std::isnan(missed)) {
    return fmt::format("the scene has no flight, and it reports {:.3g} false takeoffs per minute",
                       score.number("false_takeoffs_per_minute"));
  }
  std::string text = fmt::format("misses {:.0f} % of the time in the air", 100.0 * missed);
  if (std::isnan(is_contact)) return text + " and never reports flight";
  return text + fmt::format("; {:.0f} % of the flight it reports is contact", 100.0 * is_contact);
}

std::string standing_text(const TableRow& standing) {
  return fmt::format("{:.3f} ({}, {})", mean_of(standing), setting_of(standing),
                     noise_of(standing));
}

/// The members of a card of `benchmark_cards.html`.
Json card(const BenchmarkTables& tables, const std::string& estimator,
          const fs::path& run_directory) {
  const auto is_its_own = [&](const TableRow& row) { return estimator_of(row) == estimator; };
  const std::vector<TableRow> standings = where(tables.standings.all(), is_its_own);
  const TableRow* best = &standings.front();
  const TableRow* worst = best;
  std::size_t not_worse = 0;
  for (const TableRow& standing : standings) {
    not_worse += standing.text("is_not_significantly_worse") == "1" ? 1U : 0U;
    if (mean_of(standing) > mean_of(*best)) best = &standing;
    if (mean_of(standing) < mean_of(*worst)) worst = &standing;
  }
  std::vector<TableRow> failures = where(tables.scenes.all(), [&](const TableRow& score) {
    return is_its_own(score) && accuracy_of(score) < failure;
  });
  std::stable_sort(failures.begin(), failures.end(), [](const auto& one, const auto& other) {
    return accuracy_of(one) < accuracy_of(other);
  });
  Json items = Json::array();
  std::vector<std::string> listed;
  for (const TableRow& score : failures) {
    const std::string scene = score.text("scene");
    if (listed.size() == most_failures) break;
    if (std::find(listed.begin(), listed.end(), scene) != listed.end()) continue;
    listed.push_back(scene);
    items.push_back({{"scene", scene},
                     {"accuracy", accuracy_text(accuracy_of(score))},
                     {"errors", errors_of(score)},
                     {"engine", simulators::simulator_title(score.text("simulator"))},
                     {"setting", setting_of(score)},
                     {"noise", noise_of(score)}});
  }
  const fs::path film = run_directory / "videos" / fmt::format("worst_{}.mp4", estimator);
  return {{"title", experiments::estimator_title(estimator, tables.external)},
          {"summary", summary_of(estimator, tables.external)},
          {"not_worse", not_worse},
          {"settings", standings.size()},
          {"worst", standing_text(*worst)},
          {"best", standing_text(*best)},
          {"failure", fmt::format("{:.2f}", failure)},
          {"has_failures", !items.empty()},
          {"failures", std::move(items)},
          {"film", is_there(film) ? data_uri("video/mp4", film) : ""}};
}

/// A card for each estimator: a summary, its best and worst mean, and the scenes in which it fails,
/// with its errors there. A card shows `videos/worst_<estimator>.mp4` if the run directory has it.
std::string cards_html(const BenchmarkTables& tables, const fs::path& run_directory) {
  Json cards = Json::array();
  for (const std::string& estimator : unique(tables.standings.all(), estimator_of)) {
    if (estimator == experiments::always_contact_name) continue;
    cards.push_back(card(tables, estimator, run_directory));
  }
  return html_of("benchmark_cards.html", {{"cards", std::move(cards)}});
}

PageHeader header_of(const ReportSubject& subject, const BenchmarkTables& tables) {
  const auto count = [](const Table& table, const char* column) {
    const auto values = unique(table.all(), [&](const TableRow& row) { return row.text(column); });
    return std::to_string(values.size());
  };
  return {
      subject.experiment.name + ": which estimator works where?",
      "Balanced accuracy is the mean of the recall of contact and the recall of flight. In a "
      "scene with only one of the two, it is the recall of that one. A constant answer scores "
      "0.5 where both occur.",
      {{"estimators", count(tables.standings, "estimator")},
       {"scenes", count(tables.scenes, "scene")},
       {"robots", count(tables.standings, "robot")},
       {"sensor profiles", count(tables.standings, "sensors")},
       {"noise settings", std::to_string(unique(tables.standings.all(), noise_of).size())},
       {"physics engines", std::to_string(subject.experiment.simulators.size())}},
      fmt::format("{} {} runs per scene and engine.",
                  experiments::conditions_text(subject.experiment), subject.experiment.test.runs),
      true};
}

}  // namespace

fs::path write_benchmark_page(const ReportSubject& subject) {
  const BenchmarkTables tables = benchmark_tables(subject.directory);
  Json standings = Json::array(), scenes = Json::array();
  const std::vector<TableRow> all = tables.standings.all();
  std::string last;
  for (const TableRow& standing : all) {
    if (setting_of(standing) == last) continue;
    const bool is_first = last.empty();
    last = setting_of(standing);
    const fs::path figure =
        subject.directory / "figures" /
        fmt::format("benchmark_{}_{}.svg", standing.text("robot"), standing.text("sensors"));
    Json drawn = is_there(figure) ? figure_members(figure, subject.experiment.simulators) : Json();
    if (!drawn.is_null()) {
      drawn.update({{"is_first", is_first}, {"setting", last}});
      standings.push_back(std::move(drawn));
    }
    Json of_setting = scene_tables(tables, last, subject.experiment.simulators);
    if (of_setting.empty()) continue;
    scenes.push_back(
        {{"is_first", is_first}, {"setting", last}, {"tables", std::move(of_setting)}});
  }
  fs::path path = experiments::record_file(subject.directory, "benchmark.html");
  write_page(subject, path, header_of(subject, tables),
             {{"standings", "Ranking",
               html_of("benchmark_standings.html", {{"settings", std::move(standings)}})},
              {"matrix", "Robots and sensors", matrix_html(tables)},
              {"scenes", "Scene by scene",
               html_of("benchmark_scenes.html", {{"settings", std::move(scenes)}})},
              {"cards", "Failures of each estimator", cards_html(tables, subject.directory)}});
  return path;
}

}  // namespace touchdown::render
