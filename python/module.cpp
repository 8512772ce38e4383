// The module `touchdown._touchdown`; touchdown/__init__.py exports its public part.
#include <pybind11/pybind11.h>

#include "core/error.hpp"
#include "python/estimators.hpp"
#include "python/experiments.hpp"
#include "python/runs.hpp"

PYBIND11_MODULE(_touchdown, module) {
  namespace py = pybind11;
  // Translators run in reverse order of registration, so the subclass comes last.
  const auto error = py::register_exception<touchdown::Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception<touchdown::InputError>(
      module, "InputError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  module.attr("__version__") = TOUCHDOWN_VERSION;
  touchdown::python::add_runs(module);
  touchdown::python::add_estimators(module);
  touchdown::python::add_experiments(module);
}
