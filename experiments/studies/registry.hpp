#pragma once

#include <memory>
#include <vector>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// Each study is one file of this folder, or a few behind a header of its name.
std::unique_ptr<const Study> ablation_study();
std::unique_ptr<const Study> benchmark_study();
std::unique_ptr<const Study> closed_loop_study();
std::unique_ptr<const Study> cross_simulator_study();
std::unique_ptr<const Study> moments_study();
std::unique_ptr<const Study> odometry_study();
std::unique_ptr<const Study> vary_study();

/// Every study, in the order of planning, of texts and of their sections in written experiments.
const std::vector<std::unique_ptr<const Study>>& studies();

std::vector<const Study*> requested_studies(const Experiment& experiment);

}  // namespace touchdown::experiments
