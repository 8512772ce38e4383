// The module `touchdown._touchdown`; touchdown/__init__.py exports its public part.
#include "apps/python/module.hpp"

#include <exception>
#include <utility>

#include "core/error.hpp"
#include "core/terminal_text.hpp"

PYBIND11_MODULE(_touchdown, module) {
  namespace py = pybind11;
  const py::exception<touchdown::Error> error(module, "Error", PyExc_RuntimeError);
  const py::exception<touchdown::InputError> input_error(
      module, "InputError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  py::register_exception_translator([](std::exception_ptr thrown) {
    const auto set = [](const char* name, const std::exception& reason) {
      // Names of files may have bytes that are no text, which Python would refuse.
      const auto type = py::module_::import("touchdown._touchdown").attr(name);
      PyErr_SetString(type.ptr(), touchdown::terminal_text(reason.what(), "\n").c_str());
    };
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const touchdown::InputError& reason) {
      set("InputError", reason);
    } catch (const touchdown::Error& reason) {
      set("Error", reason);
    }
  });
  module.attr("__version__") = TOUCHDOWN_VERSION;
  touchdown::python::add_runs(module);
  touchdown::python::add_models(module);
  touchdown::python::add_estimators(module);
  touchdown::python::add_experiments(module);
}
