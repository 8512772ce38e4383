#pragma once

#include <memory>
#include <vector>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// Every study, in the order of planning and of texts.
const std::vector<std::unique_ptr<const Study>>& studies();

/// Those that the experiment file asks for.
std::vector<const Study*> requested_studies(const Experiment& experiment);

}  // namespace touchdown::experiments
