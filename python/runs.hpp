#pragma once

#include <pybind11/pybind11.h>

namespace touchdown::python {

/// Simulating, reading and writing runs; labels and scores.
void add_runs(pybind11::module_& module);

}  // namespace touchdown::python
