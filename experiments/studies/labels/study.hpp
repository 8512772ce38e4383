#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// How point-wise scores change with the definition of contact, beside the paper's tables.
std::unique_ptr<const Study> label_study();

}  // namespace touchdown::experiments
