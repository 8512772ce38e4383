#pragma once

#include <pybind11/pybind11.h>

namespace touchdown::python {

/// Adds estimators by name, step by step and over whole runs. Their models come before
/// (apps/python/models.hpp).
void add_estimators(pybind11::module_& module);

/// Adds functions that run experiments.
void add_experiments(pybind11::module_& module);

/// Adds functions that simulate, read, write and check runs, label contact and score beliefs.
void add_runs(pybind11::module_& module);

}  // namespace touchdown::python
