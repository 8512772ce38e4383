#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `learning_curve`: accuracy against the amount of labelled data.
std::unique_ptr<const Study> learning_curve_study();

}  // namespace touchdown::experiments
