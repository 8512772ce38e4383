#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiments/phase_study_score.hpp"

namespace touchdown {

inline constexpr std::array<double, 6> study_torques = {0.0, 0.25, 0.5, 1.0, 2.0, 3.0};
inline constexpr std::array<double, 6> study_accelerations = {0.0, 1.0, 3.0, 5.0, 7.0, 10.0};

/// Knees and wheels alike.
NoiseLevels levels(double torque, double acceleration);

/// All cells of the grid, by torque noise, as one score per run each.
std::vector<std::vector<RunScore>> score_grid(const Make& make, const Runs& runs);

double grid_mean(const std::vector<std::vector<RunScore>>& cells);
double worst_cell(const std::vector<std::vector<RunScore>>& cells);

void print_grid(const std::string& title, const std::vector<std::vector<RunScore>>& cells);

/// One row per estimator and noise: success with interval, events, latencies, calibration.
void print_details_header();
void print_details(const std::string& name, double torque, double acceleration,
                   const std::vector<RunScore>& scores);

/// Success with its interval over runs.
std::string success_with_bounds(const std::vector<RunScore>& scores);

/// Success of the first less that of the second, paired by run, with its interval.
std::string difference(const std::vector<RunScore>& first, const std::vector<RunScore>& second);

}  // namespace touchdown
