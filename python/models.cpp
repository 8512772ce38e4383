#include "python/models.hpp"

#include <memory>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/logs/log_steps.hpp"
#include "python/long_call.hpp"
#include "python/recording_arrays.hpp"
#include "recordings/log/byte_source.hpp"
#include "recordings/log/writer.hpp"
#include "recordings/mapping/conversion.hpp"

namespace touchdown::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

std::shared_ptr<const std::string> records_of(const py::object& recording) {
  const recordings::Recording whole =
      recording_of(recording, recording.attr("info").cast<py::dict>());
  std::ostringstream stream;
  recordings::LogWriter writer(stream, whole.info, recordings::truth_of(whole));
  for (std::size_t k = 0; k < whole.steps(); ++k) {
    writer.write(whole.observation[k], whole.action[k],
                 whole.truth.empty() ? nullptr : &whole.truth[k]);
  }
  writer.finish();
  return std::make_shared<const std::string>(stream.str());
}

using DeclaredRun = std::pair<py::object, std::optional<bool>>;

/// Fits to recordings in memory, or to logs by path.
Model fit(const std::vector<DeclaredRun>& runs, const std::string& name, double skip,
          const scoring::LabelConfig& labels, bool servo_load) {
  std::vector<experiments::FitLog> logs;
  for (const auto& [run, contact] : runs) {
    if (py::hasattr(run, "info")) {
      logs.push_back({fmt::format("recording {}", logs.size()), contact, records_of(run)});
    } else {
      logs.push_back({path_of(run), contact});
    }
  }
  const experiments::EstimatorEntry& entry = experiments::estimator_entry(name);
  if (!entry.fits()) throw InputError(fmt::format("estimator: '{}' is not fitted", name));
  if (logs.empty()) throw InputError("fit: a recording is missing");
  return long_call([&](const std::atomic<bool>& stop) {
    Model model;
    model.estimator.entry = entry;
    model.estimator.model = experiments::fit_to_logs(
        entry, logs, {.labels = labels, .skip = skip, .servo_load = servo_load, .stop = &stop},
        model.report);
    return model;
  });
}

/// What is implausible about a recording in memory, or about a log by path, which a mapping file
/// may convert.
std::vector<std::string> check(const py::object& log, const std::string& robot,
                               const std::optional<fs::path>& mapping) {
  const bool in_memory = py::hasattr(log, "info");
  if (in_memory && mapping) throw InputError("check: mapping is for logs by path");
  const auto records = in_memory ? records_of(log) : nullptr;
  const fs::path path = in_memory ? fs::path("recording") : path_of(log);
  return long_call([&](const std::atomic<bool>& stop) {
    std::optional<recordings::MappedLog> mapped;
    if (mapping) {
      mapped.emplace(path, *mapping, [&] {
        if (stop) throw Stopped("stopped");
      });
    }
    recordings::LogReader reader(
        in_memory ? recordings::memory_source(records, &stop)
                  : recordings::file_source(mapped ? mapped->path() : path, &stop),
        path.string());
    experiments::LogSteps steps(
        reader, nullptr,
        experiments::checked_robot(experiments::robot_of_file(robot), reader.info()));
    while (steps.next() != nullptr) {
    }
    std::vector<std::string> lines;
    if (mapped) lines = mapped->warnings();
    lines.insert(lines.end(), reader.warnings().begin(), reader.warnings().end());
    const std::vector<std::string> findings = steps.findings();
    lines.insert(lines.end(), findings.begin(), findings.end());
    return lines;
  });
}

void add_model_class(py::module_& module) {
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
      .def_property_readonly("seconds", [](const Model& model) { return model.report.seconds; })
      .def_property_readonly("warnings", [](const Model& model) { return model.report.warnings; })
      .def("__repr__", [](const Model& model) {
        return fmt::format("<Model of '{}'>", model.estimator.entry.name);
      });
  module.def(
      "fit",
      [](const std::vector<DeclaredRun>& runs, const std::string& estimator, double skip,
         double force_threshold, double debounce, bool servo_load) {
        return fit(runs, estimator, skip, {force_threshold, debounce}, servo_load);
      },
      "runs"_a, "estimator"_a, "skip"_a, "force_threshold"_a, "debounce"_a, "servo_load"_a);
}

}  // namespace

Model Model::load(const fs::path& path, const std::string& estimator) {
  if (path.empty()) throw InputError("expected a model's file, found an empty path");
  return {experiments::log_estimator({.name = estimator, .model = path})};
}

void Model::save(const fs::path& path) const {
  const py::gil_scoped_release unlocked;
  experiments::write_fitted_model(estimator.model, path);
}

experiments::LogEstimator with_model(experiments::LogEstimatorRequest request, const Model& model) {
  const experiments::EstimatorEntry& fitted = model.estimator.entry;
  const std::string name = request.name;
  request.model = model.estimator.request.model;
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

fs::path path_of(const py::object& object) {
  try {
    return object.cast<fs::path>();
  } catch (const py::cast_error&) {
    throw InputError(fmt::format("{}: expected a path", py::repr(object).cast<std::string>()));
  }
}

void add_models(py::module_& module) {
  add_model_class(module);
  module.def("check", &check, py::arg("log"), py::arg("robot"), py::arg("mapping"));
}

}  // namespace touchdown::python
