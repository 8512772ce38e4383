#include "experiments/studies/phase_study/tables.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "core/tables/table.hpp"
#include "experiments/plan/sensors.hpp"
#include "experiments/studies/phase_study/fit.hpp"
#include "experiments/studies/phase_study/plan.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

using Samples = std::vector<scoring::Classification>;
using Statistic = std::function<double(const scoring::Classification&)>;

const Statistic success = &scoring::Classification::success;

/// The data of the text about one engine.
struct Engine {
  const Experiment& experiment;
  const RunGroup& group;
  const CollectedCounts& counts;
  std::string name;

  Condition own(const std::string& estimator) const { return {name, name, estimator}; }
  const scoring::BootstrapConfig& bootstrap() const { return experiment.intervals.bootstrap; }
};

std::string with_bounds(const Samples& samples, const Statistic& statistic, const Engine& engine,
                        int decimals = 4) {
  return with_interval(
      scoring::bootstrap<scoring::Classification>(samples, {statistic}, engine.bootstrap()).front(),
      decimals);
}

Samples points(const std::vector<scoring::RobotScore>& scores) {
  Samples all;
  for (const scoring::RobotScore& score : scores) all.push_back(score.wheels().points);
  return all;
}

double success_in(const std::vector<ConditionCounts>& counts, const Condition& condition,
                  std::size_t cell) {
  return scoring::sum(samples_of(counts, condition, cell)).success();
}

/// Number of cells of the torque × accelerometer grid, which come first.
std::size_t grid_size(const noise::NoiseGridConfig& noise) {
  return noise.torque.size() * noise.accelerometer.size();
}

std::vector<double> grid(const Engine& engine, const Condition& condition) {
  std::vector<double> cells;
  for (std::size_t c = 0; c < grid_size(engine.experiment.noise); ++c) {
    cells.push_back(success_in(engine.counts.counted, condition, c));
  }
  return cells;
}

double mean(const std::vector<double>& cells) {
  return std::accumulate(cells.begin(), cells.end(), 0.0) / static_cast<double>(cells.size());
}

/// The accuracy of every compared estimator in one cell.
std::string compared_text(const Engine& engine, const std::vector<ConditionCounts>& counts,
                          std::size_t cell) {
  std::string text;
  for (const char* name : compared_estimators) {
    text += fmt::format(" {} {:.4f}", name, success_in(counts, engine.own(name), cell));
  }
  return text;
}

std::string grid_text(const Engine& engine, const Condition& phase) {
  const noise::NoiseGridConfig& noise = engine.experiment.noise;
  std::string text =
      "\nPhase filter: accuracy by torque noise (rows, N·m) and accelerometer noise (m/s²)\n\n| |";
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
  return text +
         fmt::format("\nGrid mean {:.4f}, worst cell ({}, {}) {}\n", mean(cells),
                     noise.torque[worst / columns], noise.accelerometer[worst % columns],
                     with_bounds(samples_of(engine.counts.counted, phase, worst), success, engine));
}

std::string grids_text(const Engine& engine) {
  const Condition own = engine.own("phase");
  std::string text = grid_text(engine, own);
  for (const std::string& other : engine.experiment.simulators) {
    if (other == engine.name) continue;
    const double transferred = mean(grid(engine, {other, engine.name, "phase"}));
    text += fmt::format("Fitted on {} instead: {:.4f} (loss {:.4f})\n\n", other, transferred,
                        mean(grid(engine, own)) - transferred);
  }
  for (const std::string& name : engine.experiment.estimators) {
    if (name == own.estimator) continue;
    const std::vector<double> cells = grid(engine, engine.own(name));
    text += fmt::format("{}: grid mean {:.4f}, worst cell {:.4f}\n", name, mean(cells),
                        *std::min_element(cells.begin(), cells.end()));
  }
  return text;
}

std::string details_row(const Engine& engine, std::size_t cell, const Condition& condition) {
  const noise::NoiseCell& noise = engine.group.scored[cell];
  const std::vector<scoring::RobotScore>& scores =
      samples_of(engine.counts.scored, condition, cell);
  const scoring::ExtendedScore extended =
      scoring::sum(samples_of(engine.counts.extended, condition, cell));
  const scoring::Score all = scoring::sum(scores).wheels();
  return fmt::format(
      "| {} | ({}, {}) | {} | {:.4f} | {} / {} | {:.3f} / {:.3f} | {:.3f} / {:.3f} | {:.1f} ± "
      "{:.1f} | {:.0f} | {:.1f} ± {:.1f} | {:.4f} |\n",
      condition.estimator, noise.torque, noise.accelerometer,
      with_bounds(points(scores), success, engine), extended.away_from_events.success(),
      with_bounds(points(scores), &scoring::Classification::no_contact_precision, engine, 3),
      with_bounds(points(scores), &scoring::Classification::no_contact_recall, engine, 3),
      all.takeoff.precision(), all.takeoff.recall(), all.landing.precision(), all.landing.recall(),
      1e3 * all.takeoff.latency_mean(), 1e3 * all.takeoff.latency_deviation(),
      extended.takeoff.percentile(0.95), 1e3 * all.landing.latency_mean(),
      1e3 * all.landing.latency_deviation(), all.calibration.brier());
}

std::string details_text(const Engine& engine) {
  std::string text =
      "\n| estimator | noise | accuracy | away from events | no-contact precision / recall | "
      "takeoff P / R | landing P / R | takeoff latency (ms) | p95 | landing latency | Brier |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  const std::vector<noise::NoiseCell>& cells = engine.group.scored;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (const char* name : compared_estimators) {
      text += details_row(engine, cell, engine.own(name));
    }
  }
  const std::size_t noisy = noise::cell_index(cells, {1.0, 5.0});
  const auto points_of = [&](const char* name) {
    return points(samples_of(engine.counts.scored, engine.own(name), noisy));
  };
  for (const char* name : {"robust", "nmn"}) {
    const Interval difference = scoring::bootstrap_differences(points_of("phase"), points_of(name),
                                                               {success}, engine.bootstrap())
                                    .front();
    text += fmt::format("\nphase − {} at (1, 5): {}\n", name, with_interval(difference, 4));
  }
  return text;
}

/// Accuracy with noise on the knees or on the wheels alone.
std::string knees_and_wheels_text(const Engine& engine) {
  std::string text = "\n\nTorque noise (knee, wheel):";
  for (std::size_t c = grid_size(engine.experiment.noise); c < engine.group.counted.size(); ++c) {
    const noise::NoiseCell& cell = engine.group.counted[c];
    text += fmt::format("\n  ({}, {}):", cell.knee, cell.wheel) +
            compared_text(engine, engine.counts.counted, c);
  }
  return text + "\n";
}

std::string scene_text(const Engine& engine) {
  std::string text = fmt::format("\n{} ({} runs), diagonal of the grid:", engine.group.name,
                                 samples_of(engine.counts.scored, engine.own("phase"), 0).size());
  for (const char* name : compared_estimators) {
    text += fmt::format("\n  {}:", name);
    const auto condition = engine.own(name);
    for (std::size_t cell = 0; cell < engine.group.scored.size(); ++cell) {
      const std::vector<scoring::RobotScore>& scores =
          samples_of(engine.counts.scored, condition, cell);
      const scoring::ExtendedScore extended =
          scoring::sum(samples_of(engine.counts.extended, condition, cell));
      text += fmt::format("\n    {} (without contact below 10 N {:.4f}, {:.2f} false takeoffs/min)",
                          with_bounds(points(scores), success, engine), extended.loaded.success(),
                          scoring::sum(scores).wheels().false_takeoffs_per_minute());
    }
  }
  return text;
}

std::string disturbed_text(const Engine& engine) {
  constexpr std::array<const char*, 8> names = {"IMU delay 10 ms",
                                                "IMU delay 5 ms",
                                                "heavy tails",
                                                "none",
                                                "torque bias 0.2 N·m (wheel 0.05)",
                                                "torque gain 1.2",
                                                "encoder noise 0.001 rad, 0.1 rad/s",
                                                "encoder noise 0.01 rad, 1 rad/s"};
  std::string text = "\n\nDisturbed at (0.25, 1):";
  for (std::size_t cell = 0; cell < engine.group.disturbed.size(); ++cell) {
    text +=
        fmt::format("\n  {}:", names[cell]) + compared_text(engine, engine.counts.disturbed, cell);
  }
  return text;
}

std::string learning_text(const Engine& engine, const Rollouts& runs) {
  std::string text = "\n\nLearning curve (grid mean):";
  for (const int segments : learning_curve) {
    const Condition condition{engine.name, engine.name, "phase", segments_fit(segments)};
    text += fmt::format(" {:.0f} s {:.4f};",
                        fitted_seconds(engine.experiment, runs, engine.name, segments),
                        mean(grid(engine, condition)));
  }
  return text + "\n";
}

}  // namespace

std::string phase_study_text(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const Plan& plan = evaluation.plan;
  std::vector<CollectedCounts> scenes;
  for (std::size_t g = 1; g < plan.groups.size(); ++g) {
    scenes.push_back(collect(plan, plan.runs_in(g), evaluation.saved));
  }
  std::string text = fmt::format("# Phase filter, test runs of seed {}{}\n", experiment.seed,
                                 setup_caption(experiment));
  for (const std::string& simulator : experiment.simulators) {
    const Engine engine{experiment, plan.groups.front(), evaluation.own, simulator};
    const double fitted = fitted_seconds(experiment, evaluation.runs, simulator,
                                         experiment.training_segments.front().runs);
    text += fmt::format(
        "\n## {}\n\nFitted on {:.1f} s; {} stairs runs × {} noise seeds.\n", simulator, fitted,
        samples_of(evaluation.own.counted, engine.own("phase"), 0).size(), experiment.noise.seeds);
    text += grids_text(engine) + details_text(engine) + knees_and_wheels_text(engine);
    for (std::size_t g = 1; g < plan.groups.size(); ++g) {
      text += scene_text({experiment, plan.groups[g], scenes[g - 1], simulator});
    }
    text += disturbed_text(engine) + learning_text(engine, evaluation.runs);
  }
  return text;
}

}  // namespace touchdown::experiments
