#pragma once

#include <pybind11/pybind11.h>

namespace touchdown::python {

/// Estimators by name, step by step and over whole runs, and the models that they are fitted with.
void add_estimators(pybind11::module_& module);

}  // namespace touchdown::python
