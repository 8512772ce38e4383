#pragma once

#include <pybind11/pybind11.h>

namespace touchdown::python {

/// Adds functions that run experiments.
void add_experiments(pybind11::module_& module);

}  // namespace touchdown::python
