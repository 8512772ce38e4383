#include "experiments/phase_study/tables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/table.hpp"
#include "experiments/phase_study/fit.hpp"
#include "experiments/phase_study/plan.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

using Samples = std::vector<scoring::Classification>;

/// Everything that is said about one engine is said of these.
struct Engine {
  const Experiment& experiment;
  const RunGroup& group;
  const CollectedCounts& counts;
  std::string name;
};

template <typename Sample>
Sample sum(const std::vector<Sample>& samples) {
  Sample all{};
  for (const Sample& sample : samples) all += sample;
  return all;
}

template <typename Counts>
const Counts& of(const std::vector<Counts>& all, const Condition& wanted) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const Counts& counts) { return counts.condition == wanted; });
}

template <typename Sample>
std::string with_bounds(const std::vector<Sample>& samples,
                        const std::function<double(const Sample&)>& statistic, const Engine& engine,
                        int decimals = 4) {
  return with_interval(
      scoring::bootstrap<Sample>(samples, {statistic}, engine.experiment.intervals.bootstrap)
          .front(),
      decimals);
}

double success(const scoring::Classification& counts) { return counts.success(); }

std::vector<scoring::Classification> points(const std::vector<scoring::RobotScore>& scores) {
  std::vector<scoring::Classification> all;
  for (const scoring::RobotScore& score : scores) all.push_back(score.wheels().points);
  return all;
}

/// The cells of the torque × accelerometer grid, which come first.
std::vector<double> grid(const Engine& engine, const Condition& condition) {
  const noise::NoiseGridConfig& noise = engine.experiment.noise;
  const ConditionCounts& counts = of(engine.counts.counted, condition);
  std::vector<double> cells;
  for (std::size_t c = 0; c < noise.torque.size() * noise.accelerometer.size(); ++c) {
    cells.push_back(sum(counts.samples[c]).success());
  }
  return cells;
}

double mean(const std::vector<double>& cells) {
  double total = 0.0;
  for (const double cell : cells) total += cell;
  return total / static_cast<double>(cells.size());
}

std::string grid_text(const Engine& engine, const Condition& phase) {
  const noise::NoiseGridConfig& noise = engine.experiment.noise;
  std::string text =
      "\nPhase filter: success by torque noise (rows, N·m) and accelerometer noise (m/s²)\n\n| |";
  for (const double a : noise.accelerometer) text += fmt::format(" {} |", a);
  text += "\n|---|";
  for (std::size_t i = 0; i < noise.accelerometer.size(); ++i) text += "---|";
  text += "\n";
  const std::vector<double> cells = grid(engine, phase);
  const std::size_t columns = noise.accelerometer.size();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i % columns == 0) text += fmt::format("| {} |", noise.torque[i / columns]);
    text += fmt::format(" {:.4f} |{}", cells[i], i % columns == columns - 1 ? "\n" : "");
  }
  const auto worst =
      static_cast<std::size_t>(std::min_element(cells.begin(), cells.end()) - cells.begin());
  return text + fmt::format("\nGrid mean {:.4f}, worst cell ({}, {}) {}\n", mean(cells),
                            noise.torque[worst / columns], noise.accelerometer[worst % columns],
                            with_bounds<scoring::Classification>(
                                of(engine.counts.counted, phase).samples[worst], success, engine));
}

std::string grids_text(const Engine& engine) {
  const Condition own{engine.name, engine.name, "phase"};
  std::string text = grid_text(engine, own);
  for (const std::string& other : engine.experiment.simulators) {
    if (other == engine.name) continue;
    const double transferred = mean(grid(engine, {other, engine.name, "phase"}));
    text += fmt::format("Fitted on {} instead: {:.4f} (loses {:.4f})\n\n", other, transferred,
                        mean(grid(engine, own)) - transferred);
  }
  for (const std::string& name : engine.experiment.estimators) {
    if (name == own.estimator) continue;
    const std::vector<double> cells = grid(engine, {engine.name, engine.name, name});
    text += fmt::format("{}: grid mean {:.4f}, worst cell {:.4f}\n", name, mean(cells),
                        *std::min_element(cells.begin(), cells.end()));
  }
  return text;
}

std::string details_row(const Engine& engine, std::size_t cell, const Condition& condition) {
  const noise::NoiseCell& noise = engine.group.scored[cell];
  const std::vector<scoring::RobotScore>& scores =
      of(engine.counts.scored[cell], condition).samples;
  const scoring::CloseScore close = sum(of(engine.counts.close[cell], condition).samples);
  const scoring::Score all = sum(scores).wheels();
  return fmt::format(
      "| {} | ({}, {}) | {} | {:.4f} | {} / {} | {:.3f} / {:.3f} | {:.3f} / {:.3f} | {:.1f} ± "
      "{:.1f} | {:.0f} | {:.1f} ± {:.1f} | {:.4f} |\n",
      condition.estimator, noise.torque, noise.accelerometer,
      with_bounds<scoring::Classification>(points(scores), success, engine),
      close.away_from_events.success(),
      with_bounds<scoring::Classification>(
          points(scores), [](const auto& c) { return c.no_contact_precision(); }, engine, 3),
      with_bounds<scoring::Classification>(
          points(scores), [](const auto& c) { return c.no_contact_recall(); }, engine, 3),
      all.takeoff.precision(), all.takeoff.recall(), all.landing.precision(), all.landing.recall(),
      1e3 * all.takeoff.latency_mean(), 1e3 * all.takeoff.latency_deviation(),
      close.takeoff_percentile(0.95), 1e3 * all.landing.latency_mean(),
      1e3 * all.landing.latency_deviation(), all.calibration.brier());
}

std::string difference_text(const Engine& engine, std::size_t cell, const Condition& first,
                            const Condition& second) {
  const Samples a = points(of(engine.counts.scored[cell], first).samples);
  const Samples b = points(of(engine.counts.scored[cell], second).samples);
  std::vector<scoring::Paired<scoring::Classification>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) pairs.push_back({a[i], b[i]});
  return with_bounds<scoring::Paired<scoring::Classification>>(
      pairs, [](const auto& pair) { return pair.first.success() - pair.second.success(); }, engine);
}

std::string details_text(const Engine& engine) {
  std::string text =
      "\n| estimator | noise | success | away from events | no-contact precision / recall | "
      "takeoff P / R | landing P / R | takeoff latency (ms) | p95 | landing latency | Brier |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  const std::vector<noise::NoiseCell>& cells = engine.group.scored;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (const char* name : compared_estimators) {
      text += details_row(engine, cell, {engine.name, engine.name, name});
    }
  }
  const std::size_t noisy = noise::cell_index(cells, {1.0, 5.0});
  for (const char* name : {"robust", "nmn"}) {
    text += fmt::format("\nphase − {} at (1, 5): {}\n", name,
                        difference_text(engine, noisy, {engine.name, engine.name, "phase"},
                                        {engine.name, engine.name, name}));
  }
  return text;
}

/// Noise on the knees or on the wheels alone.
std::string knees_and_wheels_text(const Engine& engine) {
  std::string text = "\n\nTorque noise (knee, wheel):";
  const noise::NoiseGridConfig& noise = engine.experiment.noise;
  for (std::size_t c = noise.torque.size() * noise.accelerometer.size();
       c < engine.group.counted.size(); ++c) {
    const noise::NoiseCell& cell = engine.group.counted[c];
    text += fmt::format("\n  ({}, {}):", cell.knee, cell.wheel);
    for (const char* name : compared_estimators) {
      const auto& counts = of(engine.counts.counted, {engine.name, engine.name, name});
      text += fmt::format(" {} {:.4f}", name, sum(counts.samples[c]).success());
    }
  }
  return text + "\n";
}

std::string scene_text(const Engine& engine) {
  const auto runs = of(engine.counts.scored.front(), {engine.name, engine.name, "phase"});
  std::string text =
      fmt::format("\n{} ({} runs), diagonal of the grid:", engine.group.name, runs.samples.size());
  for (const char* name : compared_estimators) {
    text += fmt::format("\n  {}:", name);
    const Condition condition{engine.name, engine.name, name};
    for (std::size_t cell = 0; cell < engine.group.scored.size(); ++cell) {
      const std::vector<scoring::RobotScore>& scores =
          of(engine.counts.scored[cell], condition).samples;
      const scoring::CloseScore close = sum(of(engine.counts.close[cell], condition).samples);
      text += fmt::format("\n    {} (without light contact {:.4f}, {:.2f} false takeoffs/min)",
                          with_bounds<scoring::Classification>(points(scores), success, engine),
                          close.firm.success(),
                          static_cast<double>(sum(scores).wheels().takeoff.false_alarms) /
                              (2.0 * close.seconds() / 60.0));
    }
  }
  return text;
}

std::string disturbed_text(const Engine& engine) {
  constexpr std::array<const char*, 8> names = {"IMU 10 ms late",
                                                "IMU 5 ms late",
                                                "heavy tails",
                                                "none",
                                                "torque bias 0.2 N·m (wheel 0.05)",
                                                "torque gain 1.2",
                                                "encoder noise 0.001 rad, 0.1 rad/s",
                                                "encoder noise 0.01 rad, 1 rad/s"};
  std::string text = "\n\nDisturbed at (0.25, 1):";
  for (std::size_t cell = 0; cell < engine.group.disturbed.size(); ++cell) {
    text += fmt::format("\n  {}:", names[cell]);
    for (const char* name : compared_estimators) {
      const auto& counts = of(engine.counts.disturbed, {engine.name, engine.name, name});
      text += fmt::format(" {} {:.4f}", name, sum(counts.samples[cell]).success());
    }
  }
  return text;
}

std::string learning_text(const Engine& engine, const PlayedRuns& runs) {
  std::string text = "\n\nLearning curve (grid mean):";
  for (const int pieces : learning_curve) {
    const Condition condition{engine.name, engine.name, "phase", pieces_fit(pieces)};
    text += fmt::format(" {:.0f} s {:.4f};", fitted_seconds(runs, engine.name, pieces),
                        mean(grid(engine, condition)));
  }
  return text + "\n";
}

}  // namespace

std::string phase_study_text(const RunRequest& request, const Plan& plan, const PlayedRuns& runs,
                             const CollectedCounts& counts, const SavedCounts& saved) {
  const Experiment& experiment = request.experiment;
  std::vector<CollectedCounts> scenes;
  for (std::size_t g = 1; g < plan.groups.size(); ++g) {
    scenes.push_back(collect(plan, plan.runs_in(g), saved));
  }
  std::string text = fmt::format("# Phase filter, test runs of seed {}\n", experiment.seed);
  for (const std::string& simulator : experiment.simulators) {
    const Engine engine{experiment, plan.groups.front(), counts, simulator};
    text += fmt::format("\n## {}\n\nFitted on {:.1f} s; {} stairs runs × {} noise seeds.\n",
                        simulator, fitted_seconds(runs, simulator, fitted_pieces),
                        of(counts.counted, {simulator, simulator, "phase"}).samples.front().size(),
                        experiment.noise.seeds);
    text += grids_text(engine) + details_text(engine) + knees_and_wheels_text(engine);
    for (std::size_t g = 1; g < plan.groups.size(); ++g) {
      text += scene_text({experiment, plan.groups[g], scenes[g - 1], simulator});
    }
    text += disturbed_text(engine) + learning_text(engine, runs);
  }
  return text;
}

}  // namespace touchdown::experiments
