#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/python/arrays.hpp"
#include "apps/python/long_call.hpp"
#include "apps/python/module.hpp"
#include "apps/python/recording_arrays.hpp"
#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "logs/model_file.hpp"

namespace touchdown::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

using DeclaredRun = std::pair<py::object, std::optional<bool>>;

/// Fits to recordings in memory, or to logs by path.
Model fit(const std::vector<DeclaredRun>& runs, const std::string& name, double skip,
          double label_share, double label_window) {
  std::vector<experiments::FitLog> logs;
  for (const auto& [run, contact] : runs) {
    if (py::hasattr(run, "info")) {
      logs.push_back({fmt::format("recording {}", logs.size()), contact, recording_of(run)});
    } else {
      logs.push_back({path_of(run), contact});
    }
  }
  const experiments::EstimatorEntry& entry = experiments::estimator_entry(name);
  if (!entry.fitting.torques) {
    throw InputError(fmt::format("estimator: '{}' is not fitted to logs", name));
  }
  if (logs.empty()) throw InputError("fit: a recording is missing");
  return long_call([&](const std::atomic<bool>& stop) {
    Model model;
    model.estimator.entry = entry;
    model.estimator.model = experiments::fit_to_logs(
        entry, logs, {.labels = {label_share, label_window}, .skip = skip, .stop = &stop},
        model.report);
    return model;
  });
}

}  // namespace

Model Model::load(const fs::path& path, const std::string& estimator) {
  if (path.empty()) throw InputError("expected a model's file, found an empty path");
  return {experiments::log_estimator({.name = estimator, .model = path})};
}

void Model::save(const fs::path& path) const {
  const py::gil_scoped_release unlocked;
  logs::save_model(estimator.model, path);
}

experiments::LogEstimator with_model(experiments::LogEstimatorRequest request, const Model& model) {
  const experiments::EstimatorEntry& fitted = model.estimator.entry;
  const std::string name = request.name;
  request.model = model.estimator.request.model;
  if (!request.robot.legs) request.robot.legs = model.estimator.request.robot.legs;
  if (name.empty() || name == fitted.name) {
    return {fitted, model.estimator.model, std::move(request)};
  }
  const experiments::EstimatorEntry& entry = experiments::estimator_entry(name);
  if (!share_model(entry, fitted)) {
    throw InputError(
        fmt::format("the model is one of '{}', which '{}' cannot use", fitted.name, name));
  }
  return {entry, model.estimator.model, std::move(request)};
}

void add_models(py::module_& module) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace)
  py::class_<Model>(
      module, "Model",
      "A fitted model, as returned by `fit`. `estimator`: the name of its estimator; "
      "`seconds`: total duration of the fitted runs (s); `warnings`: about these runs.")
      .def_static("load", &Model::load, "path"_a, "estimator"_a = "",
                  "Read a model that `save` or `touchdown fit` wrote. Some models serve several "
                  "estimators: "
                  "name one, or get the default.")
      .def("save", &Model::save, "path"_a, "Write the model as `touchdown fit` does (.npz).")
      .def_property_readonly("estimator",
                             [](const Model& model) { return model.estimator.entry.name; })
      .def_property_readonly("seconds",
                             [](const Model& model) { return model.report.fitted_to.seconds; })
      .def_property_readonly("warnings", [](const Model& model) { return model.report.warnings; })
      .def("__repr__", [](const Model& model) {
        return fmt::format("<Model of '{}'>", model.estimator.entry.name);
      });
  module.def("fit", &fit, "runs"_a, "estimator"_a, "skip"_a, "label_share"_a, "label_window"_a);
}

}  // namespace touchdown::python
