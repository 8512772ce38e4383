#pragma once

#include <pybind11/pybind11.h>

#include "models/robot.hpp"

namespace touchdown::python {

/// Reads a dictionary of Upkie's spine: `info["spine_observation"]` of a gym environment, or
/// `observation` of a log's record. A missing number or vector, or None, becomes NaN: a failed
/// sensor for estimators. `time` (s) is used if the dictionary has none. Errors: `InputError` for
/// anything but such a dictionary, and for values of another type.
models::Observation observation_of(const pybind11::dict& spine, double time);

/// Adds estimators by name, step by step and over whole runs, and their fitted models.
void add_estimators(pybind11::module_& module);

/// Adds functions that run experiments.
void add_experiments(pybind11::module_& module);

/// Adds functions that simulate, read and write runs, label contact and score beliefs.
void add_runs(pybind11::module_& module);

}  // namespace touchdown::python
