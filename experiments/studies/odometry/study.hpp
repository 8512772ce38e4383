#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `odometry`: odometry by contact source.
std::unique_ptr<const Study> odometry_study();

}  // namespace touchdown::experiments
