#pragma once

#include <pybind11/pybind11.h>
#include <vector>

#include "experiments/estimators/entry.hpp"

namespace touchdown::python {

/// Estimators that are written in Python, for an experiment: of each a dict of its `name`, `title`,
/// `summary`, the names of its `sensors`, its `revision`, and `make`, which makes one. An
/// experiment calls its `run` from whatever thread, with the signals of a whole run.
std::vector<experiments::EstimatorEntry> external_estimators_of(const pybind11::list& described);

}  // namespace touchdown::python
