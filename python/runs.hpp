#pragma once

#include <pybind11/pybind11.h>

namespace touchdown::python {

/// Adds functions that simulate, read and write runs, label contact and score beliefs.
void add_runs(pybind11::module_& module);

}  // namespace touchdown::python
