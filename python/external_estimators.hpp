#pragma once

#include <pybind11/pybind11.h>
#include <vector>

#include "experiments/estimators/entry.hpp"

namespace touchdown::python {

/// Entries of an experiment's estimators that are written in Python. Each is described by a dict of
/// its `name`, `title`, `summary`, the names of its `sensors`, its `revision`, and `make`, which
/// makes an instance. The experiment calls `run` of an instance from any thread, with the signals
/// of a whole run.
std::vector<experiments::EstimatorEntry> external_estimators_of(const pybind11::list& described);

}  // namespace touchdown::python
