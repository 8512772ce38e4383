#pragma once

#include <pybind11/pybind11.h>

namespace touchdown::python {

/// Running experiments.
void add_experiments(pybind11::module_& module);

}  // namespace touchdown::python
