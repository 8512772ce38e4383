#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <pybind11/pybind11.h>

#include "core/error.hpp"

namespace touchdown::python {

/// Runs `work(stop)` in another thread, without Python's lock, while this thread handles signals.
/// When a handler raises (Ctrl-C does), `stop` becomes true. The exception is raised here after the
/// work has ended; the error of the work, if any, is added to it as a note.
template <typename Work>
auto long_call(const Work& work) {
  namespace py = pybind11;
  std::atomic<bool> stop = false;
  std::optional<py::error_already_set> raised;
  py::gil_scoped_release unlocked;
  auto result = std::async(std::launch::async, [&] { return work(std::as_const(stop)); });
  constexpr std::chrono::milliseconds patience(50);
  while (result.wait_for(patience) != std::future_status::ready) {
    if (raised) continue;
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() == 0) continue;
    raised.emplace();
    stop = true;
  }
  if (!raised) return result.get();
  const py::gil_scoped_acquire locked;
  try {
    result.get();
  } catch (const Error& error) {
    if (py::hasattr(raised->value(), "add_note")) raised->value().attr("add_note")(error.what());
  }
  throw py::error_already_set(*raised);
}

}  // namespace touchdown::python
