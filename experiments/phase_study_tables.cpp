#include "experiments/phase_study_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiments/bootstrap.hpp"
#include "experiments/table.hpp"

namespace touchdown {

namespace {

using Statistic = std::function<double(const RunScore&)>;

std::string with_bounds(const std::vector<RunScore>& scores, const Statistic& statistic,
                        int decimals = 4) {
  const auto interval = bootstrap<RunScore>(scores, {statistic}, {.resamples = 400}).front();
  return with_interval(interval, decimals);
}

double percentile95(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size()))) - 1];
}

}  // namespace

NoiseLevels levels(double torque, double acceleration) {
  return {.knee_torque = torque, .wheel_torque = torque, .acceleration = acceleration};
}

std::vector<std::vector<RunScore>> score_grid(const Make& make, const Runs& runs) {
  std::vector<std::vector<RunScore>> cells;
  for (const double torque : study_torques) {
    for (const double acceleration : study_accelerations) {
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

double worst_cell(const std::vector<std::vector<RunScore>>& cells) {
  double worst = 1.0;
  for (const auto& cell : cells) worst = std::min(worst, success(sum(cell)));
  return worst;
}

void print_grid(const std::string& title, const std::vector<std::vector<RunScore>>& cells) {
  fmt::print("\n{}: success by torque noise (rows, N·m) and accelerometer noise (m/s²)\n\n| |",
             title);
  for (const double a : study_accelerations) fmt::print(" {} |", a);
  fmt::print("\n|---|---|---|---|---|---|---|\n");
  std::size_t worst = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i % 6 == 0) fmt::print("| {} |", study_torques[i / 6]);
    fmt::print(" {:.4f} |{}", success(sum(cells[i])), i % 6 == 5 ? "\n" : "");
    if (success(sum(cells[i])) < success(sum(cells[worst]))) worst = i;
  }
  fmt::print("\nGrid mean {:.4f}, worst cell ({}, {}) {}\n", grid_mean(cells),
             study_torques[worst / 6], study_accelerations[worst % 6],
             with_bounds(cells[worst], success));
}

void print_details_header() {
  fmt::print(
      "\n| estimator | noise | success | away from events | no-contact precision / recall | "
      "takeoff P / R | landing P / R | takeoff latency (ms) | p95 | landing latency | Brier |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
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

std::string success_with_bounds(const std::vector<RunScore>& scores) {
  return with_bounds(scores, success);
}

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

}  // namespace touchdown
