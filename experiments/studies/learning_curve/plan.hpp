#pragma once

#include <string>
#include <string_view>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// The group of the study's test runs.
inline constexpr std::string_view learning_curve_name = "learning_curve";

/// The name of the fit to training sets of this size.
std::string fit_of_size(int size);

/// Adds the experiment's own test runs once more, with conditions for every fitted estimator, size
/// and draw, at the highlighted noise settings. No run is simulated twice. Errors: `InputError` if
/// none of the experiment's estimators is fitted.
void add_learning_curve(const RunRequest& request, Plan& plan);

}  // namespace touchdown::experiments
