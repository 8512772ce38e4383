#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/studies/benchmark/standings.hpp"

namespace touchdown::experiments {

/// Standings over unseen scenes as a Markdown table for pages: a row per estimator of
/// `benchmark.table`, on the first robot with its sensors. Each noise setting has a column with the
/// mean balanced accuracy and its interval; the last column has extra switches of all settings.
/// Empty without standings.
std::string unseen_markdown(const std::vector<Standings>& unseen, const Experiment& experiment);

}  // namespace touchdown::experiments
