#include <filesystem>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/python/arrays.hpp"
#include "apps/python/long_call.hpp"
#include "apps/python/module.hpp"
#include "apps/python/signal_arrays.hpp"
#include "core/error.hpp"
#include "core/resources.hpp"
#include "core/yaml.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/text_tables.hpp"
#include "experiments/run_experiment.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::python {

namespace {

namespace fs = std::filesystem;

/// A Python object that threads without Python's lock may copy and destroy.
std::shared_ptr<const py::object> shared(py::object object) {
  return {new py::object(std::move(object)), [](const py::object* last) {
            const py::gil_scoped_acquire locked;
            delete last;
          }};
}

/// Replaces the signals of sensors that an estimator does not name, because their noise is not
/// added for it: it would see them without noise.
void hide_others(const experiments::Sensors& sensors, Signals& step) {
  const auto keep = [](bool is_named, double& signal) {
    if (!is_named) signal = NAN;
  };
  keep(sensors.acceleration, step.vertical_acceleration);
  for (double& axis : step.linear_acceleration) keep(sensors.acceleration, axis);
  for (LegSignals& leg : step.leg) {
    keep(sensors.hip_torque, leg.hip.torque);
    keep(sensors.knee_torque, leg.knee.torque);
    keep(sensors.wheel_torque, leg.wheel.torque);
    for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) {
      keep(sensors.joint_position, joint->position);
      keep(sensors.joint_velocity, joint->velocity);
    }
  }
}

/// Wraps `run` of a Python estimator for an experiment.
experiments::WholeRunEstimator whole_run_of(const py::object& estimator, const std::string& name,
                                            const experiments::Sensors& sensors,
                                            double sample_rate) {
  return [kept = shared(estimator), name, sensors, sample_rate](std::span<const Signals> steps) {
    const py::gil_scoped_acquire locked;
    std::vector<Signals> seen(steps.begin(), steps.end());
    for (Signals& step : seen) hide_others(sensors, step);
    py::dict signals = arrays_of(seen);
    signals["sample_rate"] = sample_rate;
    return beliefs_of(kept->attr("run")(signals), steps.size(), name);
  };
}

experiments::EstimatorEntry entry_of(const py::dict& described) {
  experiments::EstimatorEntry entry;
  entry.name = described["name"].cast<std::string>();
  entry.title = described["title"].cast<std::string>();
  entry.summary = described["summary"].cast<std::string>();
  entry.revision = described["revision"].cast<std::string>();
  entry.sensors =
      experiments::sensors_named(described["sensors"].cast<std::vector<std::string>>(), entry.name);
  entry.making.whole_run = [make = shared(described["make"]), name = entry.name,
                            sensors = entry.sensors](const experiments::EstimatorSetup& setup) {
    const py::gil_scoped_acquire locked;
    return whole_run_of((*make)(), name, sensors, setup.sample_rate);
  };
  return entry;
}

/// Entries of an experiment's estimators that are written in Python. Each is described by a dict of
/// its `name`, `title`, `summary`, the names of its `sensors`, its `revision`, and `make`, which
/// makes an instance. The experiment calls `run` of an instance from any thread, with the signals
/// of a whole run.
std::vector<experiments::EstimatorEntry> external_estimators_of(const py::list& described) {
  std::vector<experiments::EstimatorEntry> entries;
  for (const py::handle& one : described) entries.push_back(entry_of(one.cast<py::dict>()));
  return entries;
}

/// An experiment as given by a caller: a file, or the text of one.
YamlDocument document_of(const fs::path& file, const std::optional<std::string>& text,
                         const std::vector<std::string>& assignments) {
  const YamlDocument document =
      text ? YamlDocument::parse(*text, file) : YamlDocument::load(find_resource(file));
  return experiments::completed(document, experiments::YamlKind::experiment, assignments);
}

/// Names of an experiment's estimators that are written in Python, each with its place in the file.
std::vector<std::pair<std::string, std::string>> python_estimators(
    const fs::path& experiment, const std::optional<std::string>& text,
    const std::vector<std::string>& assignments) {
  std::vector<std::pair<std::string, std::string>> names;
  const YamlDocument document = document_of(experiment, text, assignments);
  const YAML::Node given = document.root()["estimators"];
  if (!given || !given.IsSequence()) return names;
  for (const auto& item : given) {
    if (item.IsScalar() && item.Scalar().starts_with(experiments::python_prefix)) {
      names.emplace_back(item.Scalar(), document.place_of(item, "estimators"));
    }
  }
  return names;
}

py::dict run(const fs::path& file, const std::optional<std::string>& text,
             const std::vector<std::string>& assignments, const fs::path& out, bool overwrite,
             bool pictures, bool video, const std::string& command,
             const py::list& external_estimators) {
  const std::vector<experiments::EstimatorEntry> external =
      external_estimators_of(external_estimators);
  const experiments::ExperimentResult finished = long_call([&](const std::atomic<bool>& stop) {
    const YamlDocument document = document_of(file, text, assignments);
    const experiments::Experiment experiment =
        experiments::experiment_from_yaml(document, external);
    experiments::require_files(document);
    experiments::ExperimentResult result = experiments::run_experiment(
        experiment, {.out = out, .command = command, .stop = &stop, .overwrite = overwrite});
    if (pictures) render::draw_and_report(result, video, &stop);
    return result;
  });
  py::dict about;
  about["path"] = finished.directory.path();
  about["text"] = experiments::summary_text(finished);
  about["id"] = finished.id;
  about["studies"] = finished.studies;
  about["failed_demands"] = finished.failed_demands;
  return about;
}

}  // namespace

void add_experiments(py::module_& module) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace)
  module.def("python_estimators", &python_estimators, "experiment"_a, "text"_a, "assignments"_a);
  module.def("run", &run, "experiment"_a, "text"_a, "assignments"_a, "out"_a, "overwrite"_a,
             "pictures"_a, "video"_a, "command"_a, "external_estimators"_a);
}

}  // namespace touchdown::python
