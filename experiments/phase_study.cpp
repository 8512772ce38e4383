// The phase filter's study (docs/protocol.md): fits on at most 60 s, then measures on validation
// runs or, with --report, on runs of reserved seeds. Prints Markdown.

#include <array>
#include <map>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/phase_study_fit.hpp"
#include "experiments/phase_study_tables.hpp"
#include "experiments/reserved_seeds.hpp"

namespace touchdown {
namespace {

constexpr std::uint64_t validation_seed = 2;
constexpr std::uint64_t report_seed = first_reserved_seed + 1;
constexpr int test_runs = 10;
constexpr std::array<const char*, 3> compared = {"phase", "robust", "nmn"};

void print_grids(const Fitted& own, const Fitted& other, const std::string& other_engine,
                 const Runs& runs) {
  const auto grid = score_grid(own.make.at("phase"), runs);
  print_grid("Phase filter", grid);
  const double transferred = grid_mean(score_grid(other.make.at("phase"), runs));
  fmt::print("Fitted on {} instead: {:.4f} (loses {:.4f})\n\n", other_engine, transferred,
             grid_mean(grid) - transferred);
  for (const char* name :
       {"robust", "measurement_only", "reference", "paper", "nmn", "upkie_observer"}) {
    const auto cells = score_grid(own.make.at(name), runs);
    fmt::print("{}: grid mean {:.4f}, worst cell {:.4f}\n", name, grid_mean(cells),
               worst_cell(cells));
  }
}

void print_cells(const Fitted& own, const Runs& runs) {
  constexpr std::array<std::array<double, 2>, 4> cells = {
      {{0.0, 0.0}, {0.25, 1.0}, {1.0, 5.0}, {3.0, 10.0}}};
  print_details_header();
  for (const auto& [torque, acceleration] : cells) {
    for (const char* name : compared) {
      print_details(name, torque, acceleration,
                    score_runs(own.make.at(name), runs, levels(torque, acceleration)));
    }
  }
  const auto phase = score_runs(own.make.at("phase"), runs, levels(1.0, 5.0));
  for (const char* name : {"robust", "nmn"}) {
    fmt::print("\nphase − {} at (1, 5): {}\n", name,
               difference(phase, score_runs(own.make.at(name), runs, levels(1.0, 5.0))));
  }
}

/// Noise on the knees or on the wheels alone.
void print_knees_and_wheels(const Fitted& own, const Runs& runs) {
  fmt::print("\n\nTorque noise (knee, wheel):");
  for (const NoiseLevels& noise : {NoiseLevels{.knee_torque = 4.0, .wheel_torque = 0.0},
                                   NoiseLevels{.knee_torque = 0.0, .wheel_torque = 4.0}}) {
    fmt::print("\n  ({}, {}):", noise.knee_torque, noise.wheel_torque);
    for (const char* name : compared) {
      fmt::print(" {} {:.4f}", name, success(sum(score_runs(own.make.at(name), runs, noise))));
    }
  }
  fmt::print("\n");
}

void print_scenes(const Fitted& own, const std::string& engine, std::uint64_t seed) {
  for (const char* scene : {"hang", "lift", "roam"}) {
    const Runs runs = play_all(scene, engine, seed, 0, test_runs);
    fmt::print("\n{} ({} runs), diagonal of the grid:", scene, runs.size());
    for (const char* name : compared) {
      fmt::print("\n  {}:", name);
      for (std::size_t i = 0; i < study_torques.size(); ++i) {
        const auto scores =
            score_runs(own.make.at(name), runs, levels(study_torques[i], study_accelerations[i]));
        const RunScore all = sum(scores);
        fmt::print("\n    {} (without light contact {:.4f}, {:.2f} false takeoffs/min)",
                   success_with_bounds(scores), all.but_light.success(),
                   static_cast<double>(all.takeoff.false_alarms) / (2.0 * all.seconds / 60.0));
      }
    }
  }
}

void print_disturbed(const Fitted& own, const Runs& runs) {
  const auto line = [&](const char* what, const NoiseLevels& noise, const Disturbance& d) {
    fmt::print("\n  {}:", what);
    for (const char* name : compared) {
      fmt::print(" {} {:.4f}", name, success(sum(score_runs(own.make.at(name), runs, noise, d))));
    }
  };
  const NoiseLevels noise = levels(0.25, 1.0);
  fmt::print("\n\nDisturbed at (0.25, 1):");
  line("IMU 10 ms late", noise, {.imu_delay = 10});
  line("IMU 5 ms late", noise, {.imu_delay = 5});
  line("heavy tails", noise, {.heavy_tails = true});
  line("none", noise, {});
  line("torque bias 0.2 N·m (wheel 0.05)", noise, {.torque_bias = 0.2});
  line("torque gain 1.2", noise, {.torque_gain = 1.2});
  NoiseLevels encoders = noise;
  encoders.joint_position = 0.001;
  encoders.joint_velocity = 0.1;
  line("encoder noise 0.001 rad, 0.1 rad/s", encoders, {});
  encoders.joint_position = 0.01;
  encoders.joint_velocity = 1.0;
  line("encoder noise 0.01 rad, 1 rad/s", encoders, {});
}

void print_learning_curve(const std::string& engine, const Runs& runs) {
  fmt::print("\n\nLearning curve (grid mean):");
  for (const int n : {3, 6, 12, 48}) {
    const Fitted part = fit_on(engine, n, 1e9);
    fmt::print(" {:.0f} s {:.4f};", part.seconds,
               grid_mean(score_grid(part.make.at("phase"), runs)));
  }
  fmt::print("\n");
}

void study(std::uint64_t seed) {
  std::map<std::string, Fitted> fitted;
  std::map<std::string, Runs> stairs;
  for (const std::string engine : {"mujoco", "bullet"}) {
    fitted[engine] = fit_on(engine, 24, 60.0);
    stairs[engine] = play_all("stairs", engine, seed, 0, test_runs);
  }
  fmt::print("# Phase filter, test runs of seed {}\n", seed);
  for (const std::string engine : {"mujoco", "bullet"}) {
    const Fitted& own = fitted[engine];
    const Runs& runs = stairs[engine];
    const std::string other = engine == "mujoco" ? "bullet" : "mujoco";
    fmt::print("\n## {}\n\nFitted on {:.1f} s; {} stairs runs × {} noise seeds.\n", engine,
               own.seconds, runs.size(), study_noise_seeds);
    print_grids(own, fitted[other], other, runs);
    print_cells(own, runs);
    print_knees_and_wheels(own, runs);
    print_scenes(own, engine, seed);
    print_disturbed(own, runs);
    print_learning_curve(engine, runs);
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
