// The module `touchdown._touchdown`; what users see of it is in touchdown/__init__.py.
#include <pybind11/pybind11.h>

#include "core/error.hpp"
#include "python/estimators.hpp"
#include "python/experiments.hpp"
#include "python/runs.hpp"

PYBIND11_MODULE(_touchdown, module) {
  namespace py = pybind11;
  // The later one is asked first.
  const auto error = py::register_exception<touchdown::Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception<touchdown::InputError>(
      module, "InputError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  module.attr("__version__") = TOUCHDOWN_VERSION;
  touchdown::python::add_runs(module);
  touchdown::python::add_estimators(module);
  touchdown::python::add_experiments(module);
}
