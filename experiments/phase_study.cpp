// The phase filter's study (docs/protocol.md): fits on at most 60 s, then measures on validation
// runs or, with --report, on runs of reserved seeds. Prints Markdown.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "estimator/measurement_only.hpp"
#include "estimator/phase_filter.hpp"
#include "estimator/wheel_contact_observer.hpp"
#include "experiments/bootstrap.hpp"
#include "experiments/fitting.hpp"
#include "experiments/heard_run.hpp"
#include "experiments/phase_fitting.hpp"
#include "experiments/reserved_seeds.hpp"
#include "experiments/resources.hpp"
#include "experiments/table.hpp"
#include "scenarios/engine.hpp"

namespace touchdown {
namespace {

constexpr int noise_seeds = 3;
constexpr std::uint64_t validation_seed = 2;
constexpr std::uint64_t report_seed = first_reserved_seed + 1;

using Make = std::function<std::unique_ptr<ContactEstimator>()>;
using Runs = std::vector<HeardRun>;

/// Runs [first, first + count) of a scenario, at 1 kHz, without those that fell.
Runs play_all(const std::string& file, const std::string& engine, std::uint64_t seed,
              std::int64_t first, int count) {
  Scenario scenario = load_scenario(find_resource("scenarios/" + file + ".yaml"));
  scenario.robot = find_resource(scenario.robot);
  scenario.simulation.steps.control_us = 1000;
  std::vector<std::optional<HeardRun>> played(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int i) {
    const Recording recording = play(perturbed(scenario, seed, first + i), engine, seed, first + i);
    if (recording.info.outcome == Outcome::fell || recording.info.outcome == Outcome::diverged) {
      return;
    }
    played[static_cast<std::size_t>(i)] = hear(recording, {}, {}, SampleUnit::run);
  });
  Runs runs;
  for (auto& run : played) {
    if (run) runs.push_back(std::move(*run));
  }
  return runs;
}

/// What changes between the sensors and the estimator besides noise.
struct Disturbance {
  double torque_bias = 0.0;  ///< N·m
  double torque_gain = 1.0;
  bool heavy_tails = false;   ///< noise of a tenth of the samples is four times as large
  std::size_t imu_delay = 0;  ///< steps
};

/// Counts of one run; sums over noise seeds.
struct RunScore {
  Classification points;
  Classification away_from_events;  ///< without ±20 ms of takeoffs and ±5 ms of landings
  TransitionCounts takeoff;
  TransitionCounts landing;
  Calibration calibration;
  std::vector<double> takeoff_latency;
  double seconds = 0.0;

  RunScore& operator+=(const RunScore& o) {
    points += o.points;
    away_from_events += o.away_from_events;
    takeoff += o.takeoff;
    landing += o.landing;
    calibration += o.calibration;
    takeoff_latency.insert(takeoff_latency.end(), o.takeoff_latency.begin(),
                           o.takeoff_latency.end());
    seconds += o.seconds;
    return *this;
  }
};

std::vector<bool> near_events(const ContactSequence& truth) {
  std::vector<bool> near(truth.size());
  const auto mark = [&](std::size_t event, std::size_t margin) {
    const std::size_t begin = event > margin ? event - margin : 0;
    for (std::size_t k = begin; k < std::min(event + margin, near.size()); ++k) near[k] = true;
  };
  for (const Flight& flight : flights(truth)) {
    mark(flight.takeoff, 20);
    mark(flight.landing, 5);
  }
  return near;
}

RunScore score_run(const Make& make, const HeardRun& run, const NoiseLevels& levels, int seed,
                   const Disturbance& d) {
  const NoiseKey key{7000 + static_cast<std::uint64_t>(seed),
                     static_cast<std::uint64_t>(run.info.run) + 100'000 * run.info.seed};
  UnitNoise noise = unit_noise(run, key);
  if (d.heavy_tails) {
    // Which samples are outliers is drawn from a channel that is not otherwise used here.
    std::vector<double> pick(run.steps());
    fill_standard_normal(key, NoiseChannel::left_hip_position, 0, pick);
    constexpr double upper_tenth = 1.2815515655446004;
    for (std::size_t k = 0; k < run.steps(); ++k) {
      if (pick[k] < upper_tenth) continue;
      for (std::size_t leg = 0; leg < wheel_count; ++leg) {
        noise.knee_torque[leg][k] *= 4.0;
        noise.wheel_torque[leg][k] *= 4.0;
      }
      noise.vertical_acceleration[k] *= 4.0;
    }
  }
  const auto estimator = make();
  Prediction prediction;
  prediction.fill({ContactSequence(run.steps()), std::vector<double>(run.steps())});
  for (std::size_t k = 0; k < run.steps(); ++k) {
    Signals s = noisy(run, noise, levels, k);
    s.vertical_acceleration =
        noisy(run, noise, levels, k - std::min(k, d.imu_delay)).vertical_acceleration;
    for (LegSignals& leg : s.leg) {
      leg.knee.torque = d.torque_gain * leg.knee.torque + d.torque_bias;
      leg.wheel.torque = d.torque_gain * leg.wheel.torque + 0.25 * d.torque_bias;
    }
    const Belief& belief = estimator->update(s);
    for (std::size_t w = 0; w < wheel_count; ++w) {
      prediction[w].contact[k] = std::uint8_t{belief.wheel[w].contact};
      prediction[w].p_contact[k] = belief.wheel[w].p_contact;
    }
  }
  const ScoringConfig scoring;
  RunScore result;
  for (std::size_t w = 0; w < wheel_count; ++w) {
    const ContactSequence& truth = run.contact[w];
    const Score counts = score(truth, prediction[w], {0}, 1000, scoring).front();
    result.points += counts.points;
    result.takeoff += counts.takeoff;
    result.landing += counts.landing;
    result.calibration += counts.calibration;
    const std::vector<bool> near = near_events(truth);
    for (std::size_t k = 300; k < truth.size(); ++k) {
      if (!near[k]) result.away_from_events.add(truth[k] != 0, prediction[w].contact[k] != 0);
    }
    for (const JudgedTransition& judged :
         judge_transitions(truth, prediction[w].contact, 1e-3, scoring)) {
      if (judged.kind == EventKind::takeoff && judged.verdict == Judgement::detected) {
        result.takeoff_latency.push_back(static_cast<double>(judged.latency));
      }
    }
  }
  result.seconds = 1e-3 * static_cast<double>(run.steps());
  return result;
}

/// One score per run.
std::vector<RunScore> score_runs(const Make& make, const Runs& runs, const NoiseLevels& levels,
                                 const Disturbance& disturbance = {}) {
  std::vector<RunScore> parts(runs.size() * noise_seeds);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    parts[i] = score_run(make, runs[i / noise_seeds], levels, static_cast<int>(i % noise_seeds),
                         disturbance);
  });
  std::vector<RunScore> scores(runs.size());
  for (std::size_t i = 0; i < parts.size(); ++i) scores[i / noise_seeds] += parts[i];
  return scores;
}

RunScore sum(const std::vector<RunScore>& scores) {
  RunScore all;
  for (const RunScore& score : scores) all += score;
  return all;
}

using Statistic = std::function<double(const RunScore&)>;

std::string with_bounds(const std::vector<RunScore>& scores, const Statistic& statistic,
                        int decimals = 4) {
  const auto interval = bootstrap<RunScore>(scores, {statistic}, {.resamples = 400}).front();
  return with_interval(interval, decimals);
}

double success(const RunScore& score) { return score.points.success(); }

double percentile95(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size()))) - 1];
}

NoiseLevels levels(double torque, double acceleration) {
  return {.knee_torque = torque, .wheel_torque = torque, .acceleration = acceleration};
}

constexpr std::array<double, 6> torques = {0.0, 0.25, 0.5, 1.0, 2.0, 3.0};
constexpr std::array<double, 6> accelerations = {0.0, 1.0, 3.0, 5.0, 7.0, 10.0};

/// All cells of the grid, by torque noise, as one score per run each.
std::vector<std::vector<RunScore>> score_grid(const Make& make, const Runs& runs) {
  std::vector<std::vector<RunScore>> cells;
  for (const double torque : torques) {
    for (const double acceleration : accelerations) {
      cells.push_back(score_runs(make, runs, levels(torque, acceleration)));
    }
  }
  return cells;
}

double grid_mean(const std::vector<std::vector<RunScore>>& cells) {
  double total = 0.0;
  for (const auto& cell : cells) total += success(sum(cell));
  return total / static_cast<double>(cells.size());
}

void print_grid(const std::string& title, const std::vector<std::vector<RunScore>>& cells) {
  fmt::print("\n{}: success by torque noise (rows, N·m) and accelerometer noise (m/s²)\n\n| |",
             title);
  for (const double a : accelerations) fmt::print(" {} |", a);
  fmt::print("\n|---|---|---|---|---|---|---|\n");
  std::size_t worst = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i % 6 == 0) fmt::print("| {} |", torques[i / 6]);
    fmt::print(" {:.4f} |{}", success(sum(cells[i])), i % 6 == 5 ? "\n" : "");
    if (success(sum(cells[i])) < success(sum(cells[worst]))) worst = i;
  }
  fmt::print("\nGrid mean {:.4f}, worst cell ({}, {}) {}\n", grid_mean(cells), torques[worst / 6],
             accelerations[worst % 6], with_bounds(cells[worst], success));
}

void print_details(const std::string& name, double torque, double acceleration,
                   const std::vector<RunScore>& scores) {
  const RunScore all = sum(scores);
  fmt::print(
      "| {} | ({}, {}) | {} | {:.4f} | {} / {} | {:.3f} / {:.3f} | {:.3f} / {:.3f} | {:.1f} ± "
      "{:.1f} "
      "| {:.0f} | {:.1f} ± {:.1f} | {:.4f} |\n",
      name, torque, acceleration, with_bounds(scores, success), all.away_from_events.success(),
      with_bounds(
          scores, [](const auto& s) { return s.points.no_contact_precision(); }, 3),
      with_bounds(
          scores, [](const auto& s) { return s.points.no_contact_recall(); }, 3),
      all.takeoff.precision(), all.takeoff.recall(), all.landing.precision(), all.landing.recall(),
      1e3 * all.takeoff.latency_mean(), 1e3 * all.takeoff.latency_deviation(),
      percentile95(all.takeoff_latency), 1e3 * all.landing.latency_mean(),
      1e3 * all.landing.latency_deviation(), all.calibration.brier());
}

/// Estimators by name, fitted on one engine's runs.
struct Fitted {
  std::shared_ptr<PhaseModel> phase;
  std::map<std::string, Make> make;
  double seconds = 0.0;
};

/// Drops what a run's fit does not need: keeps steps [begin, end).
HeardRun cut(const HeardRun& run, std::size_t begin, std::size_t end) {
  HeardRun piece;
  piece.info = run.info;
  const auto first = static_cast<std::ptrdiff_t>(std::min(begin, run.steps()));
  const auto last = static_cast<std::ptrdiff_t>(std::min(end, run.steps()));
  piece.signals.assign(run.signals.begin() + first, run.signals.begin() + last);
  for (std::size_t w = 0; w < wheel_count; ++w) {
    piece.contact[w].assign(run.contact[w].begin() + first, run.contact[w].begin() + last);
  }
  return piece;
}

Fitted fit_on(const std::string& engine, int stairs_runs, double most_seconds) {
  const Runs stairs = play_all("stairs", engine, 1, first_fit_run, stairs_runs);
  const Runs hang = play_all("hang", engine, 1, first_fit_run, 1);
  const Runs lift = play_all("lift", engine, 1, first_fit_run, 1);
  Runs pieces;
  for (const HeardRun& run : stairs) pieces.push_back(cut(run, 2300, run.steps()));
  for (const HeardRun& run : hang) pieces.push_back(cut(run, 300, 3800));
  for (const HeardRun& run : lift) pieces.push_back(cut(run, 300, 7300));
  Fitted fitted;
  std::vector<const HeardRun*> used;
  for (const HeardRun& piece : pieces) {
    fitted.seconds += 1e-3 * static_cast<double>(piece.steps());
    used.push_back(&piece);
  }
  if (fitted.seconds > most_seconds) {
    throw Error(fmt::format("fitted on {:.1f} s, more than {} s", fitted.seconds, most_seconds));
  }
  fitted.phase = std::make_shared<PhaseModel>(fit_phases(used, PhaseFitConfig{}, 0.0));
  const auto phase = std::make_shared<PhaseFilter>(*fitted.phase);
  fitted.make["phase"] = [phase] { return std::make_unique<PhaseFilter>(*phase); };
  fitted.make["upkie_observer"] = [] { return std::make_unique<UpkieObserver>(); };
  std::vector<const HeardRun*> whole;
  for (const HeardRun& run : stairs) whole.push_back(&run);
  for (const char* name : {"robust", "reference", "paper"}) {
    const BayesFilterConfig config = BayesFilterConfig::named(name);
    const MeasurementModel model = fit(whole, config.measurement, {});
    fitted.make[name] = [=] { return std::make_unique<BayesFilter>(model, config); };
    if (std::string(name) == "robust") {
      fitted.make["measurement_only"] = [=] {
        return std::make_unique<MeasurementOnly>(model, config);
      };
    }
  }
  return fitted;
}

/// Success of the first less that of the second, paired by run.
std::string difference(const std::vector<RunScore>& first, const std::vector<RunScore>& second) {
  std::vector<Paired<RunScore>> pairs;
  for (std::size_t i = 0; i < first.size(); ++i) pairs.push_back({first[i], second[i]});
  return with_interval(
      bootstrap<Paired<RunScore>>(
          pairs, {[](const auto& pair) { return success(pair.first) - success(pair.second); }},
          {.resamples = 400})
          .front(),
      4);
}

void study(std::uint64_t seed) {
  constexpr int test_runs = 10;
  std::map<std::string, Fitted> fitted;
  std::map<std::string, Runs> stairs;
  for (const std::string engine : {"mujoco", "bullet"}) {
    fitted[engine] = fit_on(engine, 4, 60.0);
    stairs[engine] = play_all("stairs", engine, seed, 0, test_runs);
  }
  fmt::print("# Phase filter, test runs of seed {}\n", seed);
  for (const std::string engine : {"mujoco", "bullet"}) {
    const Fitted& own = fitted[engine];
    const Runs& runs = stairs[engine];
    fmt::print("\n## {}\n\nFitted on {:.1f} s; {} stairs runs × {} noise seeds.\n", engine,
               own.seconds, runs.size(), noise_seeds);
    const auto grid = score_grid(own.make.at("phase"), runs);
    print_grid("Phase filter", grid);
    const std::string other = engine == "mujoco" ? "bullet" : "mujoco";
    const double transferred = grid_mean(score_grid(fitted[other].make.at("phase"), runs));
    fmt::print("Fitted on {} instead: {:.4f} (loses {:.4f})\n\n", other, transferred,
               grid_mean(grid) - transferred);
    for (const char* name :
         {"robust", "measurement_only", "reference", "paper", "upkie_observer"}) {
      const auto cells = score_grid(own.make.at(name), runs);
      double worst = 1.0;
      for (const auto& cell : cells) worst = std::min(worst, success(sum(cell)));
      fmt::print("{}: grid mean {:.4f}, worst cell {:.4f}\n", name, grid_mean(cells), worst);
    }
    fmt::print(
        "\n| estimator | noise | success | away from events | no-contact precision / recall | "
        "takeoff P / R | landing P / R | takeoff latency (ms) | p95 | landing latency | Brier |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
    constexpr std::array<std::array<double, 2>, 4> cells = {
        {{0.0, 0.0}, {0.25, 1.0}, {1.0, 5.0}, {3.0, 10.0}}};
    for (const auto& [torque, acceleration] : cells) {
      for (const char* name : {"phase", "robust"}) {
        print_details(name, torque, acceleration,
                      score_runs(own.make.at(name), runs, levels(torque, acceleration)));
      }
    }
    fmt::print("\nphase − robust at (1, 5): {}\n",
               difference(score_runs(own.make.at("phase"), runs, levels(1.0, 5.0)),
                          score_runs(own.make.at("robust"), runs, levels(1.0, 5.0))));
    for (const char* scene : {"hang", "lift", "roam"}) {
      const Runs scene_runs = play_all(scene, engine, seed, 0, test_runs);
      fmt::print("\n{} ({} runs), diagonal of the grid:", scene, scene_runs.size());
      for (const char* name : {"phase", "robust"}) {
        fmt::print("\n  {}:", name);
        for (std::size_t i = 0; i < torques.size(); ++i) {
          const RunScore all =
              sum(score_runs(own.make.at(name), scene_runs, levels(torques[i], accelerations[i])));
          fmt::print(" {:.4f} ({:.2f} false takeoffs/min)", success(all),
                     static_cast<double>(all.takeoff.false_alarms) / (2.0 * all.seconds / 60.0));
        }
      }
    }
    fmt::print("\n\nDisturbed at (0.25, 1):");
    const std::map<std::string, Disturbance> disturbances = {
        {"none", {}},
        {"torque bias 0.2 N·m (wheel 0.05)", {.torque_bias = 0.2}},
        {"torque gain 1.2", {.torque_gain = 1.2}},
        {"heavy tails", {.heavy_tails = true}},
        {"IMU 5 ms late", {.imu_delay = 5}},
        {"IMU 10 ms late", {.imu_delay = 10}}};
    for (const auto& [what, disturbance] : disturbances) {
      fmt::print("\n  {}:", what);
      for (const char* name : {"phase", "robust"}) {
        fmt::print(
            " {} {:.4f}", name,
            success(sum(score_runs(own.make.at(name), runs, levels(0.25, 1.0), disturbance))));
      }
    }
    fmt::print("\n\nLearning curve (grid mean):");
    for (const int n : {1, 2, 8}) {
      const Fitted part = fit_on(engine, n, 1e9);
      fmt::print(" {:.0f} s {:.4f};", part.seconds,
                 grid_mean(score_grid(part.make.at("phase"), runs)));
    }
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace touchdown

int main(int argc, char** argv) {
  try {
    const bool report = argc > 1 && std::string(argv[1]) == "--report";
    touchdown::study(report ? touchdown::report_seed : touchdown::validation_seed);
    return 0;
  } catch (const touchdown::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
