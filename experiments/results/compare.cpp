#include "experiments/results/compare.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for_each.h>

#include "core/columns.hpp"
#include "core/error.hpp"
#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

using scoring::Classification;

/// What identifies a cell in both runs: names and noise.
auto identity_of(const SampledCell& cell) {
  return std::tuple(cell.condition.test_simulator, cell.condition.fit_simulator,
                    cell.condition.estimator, cell.noise.knee, cell.noise.wheel,
                    cell.noise.accelerometer);
}

/// "1 N·m, 5 m/s²".
std::string levels_text(const noise::NoiseCell& noise) {
  const std::string torque = std::isnan(noise.torque)
                                 ? fmt::format("knee {}, wheel {}", noise.knee, noise.wheel)
                                 : fmt::format("{}", noise.torque);
  return fmt::format("{} N·m, {} m/s²", torque, noise.accelerometer);
}

/// "robust", "robust fitted in bullet".
std::string name_of(const Condition& condition) {
  return condition.is_fitted_in_domain()
             ? condition.estimator
             : fmt::format("{} fitted in {}", condition.estimator, condition.fit_simulator);
}

std::string text_of(const SampleKey& key) {
  return fmt::format("{} run {}{}", key.scenario, key.run,
                     key.segment > 0 ? fmt::format(" segment {}", key.segment) : std::string());
}

/// The first names, and the number of the others.
std::string some_of(std::vector<std::string> names) {
  constexpr std::size_t most = 3;
  if (names.size() > most) {
    const std::size_t more = names.size() - most;
    names.resize(most);
    names.push_back(fmt::format("{} more", more));
  }
  return fmt::format("{}", fmt::join(names, "; "));
}

/// A cell of both runs.
struct CommonCell {
  const SampledCell* before;
  const SampledCell* after;
  ComparedCell compared = {};
  std::vector<std::string> single = {};  ///< samples that one run alone has
  std::string reason = {};               ///< why they are not comparable; empty: they are
};

/// Pairs the samples of a cell that both runs have.
void compare(CommonCell& cell, const scoring::BootstrapConfig& bootstrap) {
  std::vector<Classification> first;
  std::vector<Classification> second;
  for (const auto& [key, before] : cell.before->samples) {
    const auto found = cell.after->samples.find(key);
    if (found == cell.after->samples.end()) {
      cell.single.push_back(text_of(key));
      continue;
    }
    const Classification& after = found->second;
    if (cell.reason.empty() &&
        (before.contact() != after.contact() || before.flight() != after.flight())) {
      cell.reason = fmt::format(
          "{} has {} steps in contact and {} in flight before, {} and {} after (another seed, "
          "scenario, robot, label or number of noise seeds?)",
          text_of(key), before.contact(), before.flight(), after.contact(), after.flight());
    }
    first.push_back(before);
    second.push_back(after);
  }
  for (const auto& [key, after] : cell.after->samples) {
    if (!cell.before->samples.contains(key)) cell.single.push_back(text_of(key));
  }
  if (first.empty()) cell.reason = "they have no run in common";
  if (!cell.reason.empty()) return;
  std::vector<std::function<double(const Classification&)>> statistics;
  for (const PointMetric& metric : compared_metrics) statistics.emplace_back(metric.of);
  const std::vector<Interval> differences =
      scoring::bootstrap_differences(second, first, statistics, bootstrap);
  cell.compared = {cell.after->condition, cell.after->noise, first.size(), first == second};
  for (std::size_t m = 0; m < differences.size(); ++m) {
    cell.compared.metric[m] = {statistics[m](scoring::sum(first)),
                               statistics[m](scoring::sum(second)), differences[m]};
  }
}

/// The cells that one run alone has, in one line.
void note_single(const std::string& directory, const std::vector<const SampledCell*>& cells,
                 std::vector<std::string>& notes) {
  if (cells.empty()) return;
  std::vector<std::string> names;
  const auto condition_of = [](const SampledCell* cell) { return cell->condition; };
  for (const auto& [condition, own] : group_by(cells, condition_of)) {
    names.push_back(fmt::format("{} {}, {}", condition.test_simulator, name_of(condition),
                                levels_text(own.front()->noise)));
    if (own.size() > 1) names.back() += fmt::format(" and {} more", own.size() - 1);
  }
  notes.push_back(fmt::format("only in {}: {}: {}", directory, plural(cells.size(), "cell"),
                              some_of(std::move(names))));
}

/// What is not compared of the cells of both runs: those of each engine that are not of the same
/// runs, with the first reason; samples that one run alone has, because the robot fell in the other
/// one for example.
std::vector<std::string> notes_about(const std::vector<CommonCell>& cells) {
  std::vector<std::string> notes;
  const auto refused = where(cells, [](const CommonCell& cell) { return !cell.reason.empty(); });
  for (const auto& [engine, own] : group_by(
           refused, [](const CommonCell& cell) { return cell.after->condition.test_simulator; })) {
    notes.push_back(fmt::format("not the same runs: {} of {}: {}", plural(own.size(), "cell"),
                                engine, own.front().reason));
  }
  const auto partly = where(
      cells, [](const CommonCell& cell) { return cell.reason.empty() && !cell.single.empty(); });
  if (partly.empty()) return notes;
  notes.push_back(fmt::format("in one of the runs only: {} of {}: {}",
                              plural(partly.front().single.size(), "sample"),
                              plural(partly.size(), "cell"), some_of(partly.front().single)));
  return notes;
}

/// The cells with a difference of the metric, the largest first.
std::vector<ComparedCell> by_difference(const Comparison& comparison, std::size_t metric) {
  const auto size = [&](const ComparedCell& cell) {
    return std::abs(cell.metric[metric].difference.estimate);
  };
  std::vector<ComparedCell> cells =
      where(comparison.cells, [&](const ComparedCell& cell) { return !std::isnan(size(cell)); });
  std::ranges::stable_sort(cells, std::greater(), size);
  return cells;
}

std::string level_text(const Comparison& comparison) {
  return fmt::format("{:.3g} %", 100.0 * comparison.level);
}

/// "2 of 12 cells moved; 6 with equal counts in every run; by chance alone about 0.3 of the other 6
/// would".
std::string chance_text(const Comparison& comparison, std::size_t moved) {
  const std::size_t all = comparison.cells.size();
  const auto equal = static_cast<std::size_t>(
      std::ranges::count_if(comparison.cells, &ComparedCell::has_equal_counts));
  const double by_chance = (1.0 - comparison.level) * static_cast<double>(all - equal);
  std::string text = fmt::format("{} of {} moved", moved, plural(all, "cell"));
  if (equal == all) return text + ": all have equal counts in every run\n";
  if (equal > 0) text += fmt::format("; {} with equal counts in every run", equal);
  return text + fmt::format("; by chance alone about {:.1f}{} would\n", by_chance,
                            equal > 0 ? fmt::format(" of the other {}", all - equal) : "");
}

}  // namespace

Comparison compare(const SampledRun& before, const SampledRun& after) {
  std::map<decltype(identity_of(before.cells.front())), const SampledCell*> rest;
  for (const SampledCell& cell : before.cells) rest.emplace(identity_of(cell), &cell);
  std::vector<CommonCell> common;
  std::vector<const SampledCell*> only_before;
  std::vector<const SampledCell*> only_after;
  for (const SampledCell& cell : after.cells) {
    if (const auto same = rest.extract(identity_of(cell))) {
      common.push_back({same.mapped(), &cell});
    } else {
      only_after.push_back(&cell);
    }
  }
  for (const SampledCell& cell : before.cells) {
    if (rest.contains(identity_of(cell))) only_before.push_back(&cell);
  }
  if (common.empty()) {
    const auto estimators = [](const SampledRun& run) {
      return unique(run.cells, [](const SampledCell& cell) { return cell.condition.estimator; });
    };
    throw InputError(fmt::format(
        "{} and {} have no cell of engine, estimator and noise in common: estimators of the first: "
        "{}; of the second: {}",
        before.directory, after.directory, fmt::join(estimators(before), ", "),
        fmt::join(estimators(after), ", ")));
  }
  tbb::parallel_for_each(common, [&](CommonCell& cell) { compare(cell, after.bootstrap); });
  Comparison result{before.directory, after.directory, after.bootstrap.level};
  for (const CommonCell& cell : common) {
    if (cell.reason.empty()) result.cells.push_back(cell.compared);
  }
  result.left_out = notes_about(common);
  if (result.cells.empty()) {
    throw InputError(
        fmt::format("{} and {}: {}", before.directory, after.directory, result.left_out.front()));
  }
  note_single(before.directory, only_before, result.left_out);
  note_single(after.directory, only_after, result.left_out);
  return result;
}

Table comparison_table(const Comparison& comparison) {
  Columns<ComparedCell> columns;
  columns.text("simulator", [](const ComparedCell& cell) { return cell.condition.test_simulator; })
      .text("fit_simulator", [](const ComparedCell& cell) { return cell.condition.fit_simulator; })
      .text("estimator", [](const ComparedCell& cell) { return cell.condition.estimator; })
      .part(&ComparedCell::noise, noise_columns())
      .part(&ComparedCell::noise, knee_wheel_columns())
      .runs("pairs", &ComparedCell::pairs);
  for (std::size_t m = 0; m < compared_metrics.size(); ++m) {
    const std::string name = compared_metrics[m].name;
    columns
        .metric(name + "_before", [m](const ComparedCell& cell) { return cell.metric[m].before; })
        .metric(name + "_after", [m](const ComparedCell& cell) { return cell.metric[m].after; })
        .interval(name + "_difference",
                  [m](const ComparedCell& cell) { return cell.metric[m].difference; })
        .flag(name + "_moved",
              [m](const ComparedCell& cell) { return cell.metric[m].has_moved(); });
  }
  return columns.table(comparison.cells);
}

std::string comparison_text(const Comparison& comparison, std::size_t metric) {
  constexpr std::size_t most = 20;
  const std::vector<ComparedCell> moved =
      where(by_difference(comparison, metric),
            [&](const ComparedCell& cell) { return cell.metric[metric].has_moved(); });
  TextTable table{{"engine", "estimator", "noise", "before", "after", "difference"}, {}};
  for (const ComparedCell& cell : std::span(moved).first(std::min(moved.size(), most))) {
    const Movement& movement = cell.metric[metric];
    table.rows.push_back({cell.condition.test_simulator, name_of(cell.condition),
                          levels_text(cell.noise), fixed(movement.before, 3),
                          fixed(movement.after, 3), with_interval(movement.difference)});
  }
  std::string text = fmt::format("{}: {} minus {}, {} intervals over pairs of equal runs\n\n",
                                 compared_metrics[metric].title, comparison.after,
                                 comparison.before, level_text(comparison));
  if (!moved.empty()) text += to_text(table, 3);
  if (moved.size() > most) text += fmt::format("… and {} more\n", moved.size() - most);
  text += (moved.empty() ? "" : "\n") + chance_text(comparison, moved.size());
  for (const std::string& line : comparison.left_out) text += line + "\n";
  return text;
}

FigureSpec comparison_figure(const Comparison& comparison, std::size_t metric) {
  constexpr std::size_t most = 40;
  const Table table = comparison_table(comparison);
  const std::string title = compared_metrics[metric].title;
  FigureSpec spec{.name = "compare", .table = "compare.csv"};
  spec.panels = combinations_in(table, {"simulator", "fit_simulator"}, [](const auto& engines) {
    const std::string tested = simulators::simulator_title(engines[0]);
    return engines[0] == engines[1]
               ? tested
               : fmt::format("{}, fitted in {}", tested, simulators::simulator_title(engines[1]));
  });
  const std::vector<EstimatorEntry> external = written_estimators(comparison.after);
  spec.series = groups_in(table, "estimator",
                          [&](const std::string& name) { return estimator_title(name, external); });
  std::erase_if(spec.series.groups, [&](const FigureGroup& estimator) {
    return std::ranges::all_of(comparison.cells, [&](const ComparedCell& cell) {
      return cell.has_equal_counts || cell.condition.estimator != estimator.values.front();
    });
  });
  spec.rows.columns = {"knee_noise_nm", "wheel_noise_nm", "accelerometer_noise_mps2"};
  const auto settings = unique(by_difference(comparison, metric), &ComparedCell::noise);
  for (const noise::NoiseCell& noise : std::span(settings).first(std::min(settings.size(), most))) {
    spec.rows.groups.push_back(
        {{exact(noise.knee), exact(noise.wheel), exact(noise.accelerometer)}, levels_text(noise)});
  }
  spec.measures = {axis_with_interval(std::string(compared_metrics[metric].name) + "_difference",
                                      fmt::format("difference of {}", title))};
  spec.title = fmt::format("Difference of {} between two runs", title);
  if (spec.series.groups.size() == 1) spec.title += ": " + spec.series.groups.front().title;
  spec.caption = fmt::format(
      "{} minus {}, with {} bootstrap intervals over pairs of equal runs: {}, the one with the "
      "largest difference first. Estimators with equal counts in every run are left out.",
      comparison.after, comparison.before, level_text(comparison),
      settings.size() > most ? fmt::format("{} of {} noise settings", most, settings.size())
                             : plural(settings.size(), "noise setting"));
  spec.alt = spec.title + "." + values_text(spec, table);
  return spec;
}

}  // namespace touchdown::experiments
