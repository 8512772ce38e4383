#include <cmath>
#include <filesystem>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/arrays.hpp"
#include "apps/python/long_call.hpp"
#include "apps/python/module.hpp"
#include "apps/python/recording_arrays.hpp"
#include "core/error.hpp"
#include "core/resources.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/logs/robot.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/mapping/conversion.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/scenario_file.hpp"
#include "scoring/score.hpp"
#include "simulators/registry.hpp"

namespace touchdown::python {

namespace {

namespace fs = std::filesystem;

py::tuple with_info(logs::Recording recording) {
  py::dict info = dict_of(recording.info);
  return py::make_tuple(arrays_of(std::move(recording)), info);
}

py::tuple simulate(const fs::path& scenario, const std::string& simulator, std::uint64_t seed,
                   std::optional<std::int64_t> run, const std::vector<std::string>& assignments) {
  if (run && *run < 0) throw InputError("run: expected a number of at least 0");
  return with_info(long_call([&](const std::atomic<bool>& stop) {
    YamlDocument document = scenarios::scenario_document(scenario.string());
    for (const std::string& assignment : assignments) document.override_value(assignment);
    experiments::require_yaml_kind(document, experiments::YamlKind::scenario);
    scenarios::Scenario rollout = scenarios::complete_scenario(document);
    if (run) rollout = scenarios::perturbed(rollout, seed, *run);
    return scenarios::play(rollout, simulator, seed, run.value_or(0),
                           [&](double /*time*/) { return !stop; });
  }));
}

py::tuple load(const fs::path& path, const std::optional<fs::path>& mapping) {
  std::vector<std::string> warnings;
  py::tuple read = with_info(long_call([&](const std::atomic<bool>& stop) {
    logs::LogReader reader = logs::open_log(path, mapping.value_or(fs::path()), &stop);
    logs::Recording recording = logs::read_recording(reader, &warnings);
    if (stop) throw Stopped("stopped");
    return recording;
  }));
  for (const std::string& warning : warnings) {
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  }
  return read;
}

void save(const py::object& arrays, const py::dict& info, const fs::path& path) {
  const logs::Recording recording = recording_of(arrays, info);
  const py::gil_scoped_release unlocked;
  logs::write_recording(recording, path);
}

py::array_t<bool> contact_labels(const py::object& normal_force, double period, double robot_mass,
                                 double share, double window) {
  py::dict arrays;
  arrays["normal_force"] = normal_force;
  ArrayMap map(arrays, "labels");
  const StepArray force = map.column("normal_force", models::wheel_count);
  WheelLabels labels;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    std::vector<double> of_wheel(force.steps());
    for (std::size_t k = 0; k < of_wheel.size(); ++k) of_wheel[k] = force(k, wheel);
    labels[wheel] = scoring::contact_labels(of_wheel, period, robot_mass, {share, window});
  }
  return array_of(labels);
}

py::dict score(const py::object& given_beliefs, const py::object& truth, double period, double skip,
               double hold_off, double takeoff_opens, double landing_opens, double minimum_flight) {
  const scoring::ScoringConfig config{skip, hold_off, takeoff_opens, landing_opens, minimum_flight};
  py::dict arrays;
  arrays["contact"] = truth;
  ArrayMap map(arrays, "score");
  const StepArray contact = map.column("contact", models::wheel_count);
  const std::vector<Belief> beliefs = beliefs_of(given_beliefs, contact.steps(), "score");
  WheelLabels labels;
  scoring::Prediction prediction;
  for (const Belief& belief : beliefs) scoring::add_step(prediction, belief);
  for (std::size_t k = 0; k < contact.steps(); ++k) {
    for (std::size_t w = 0; w < models::wheel_count; ++w) {
      labels[w].push_back(contact(k, w) != 0.0 ? 1 : 0);
    }
  }
  const scoring::RobotScore scored =
      scoring::score(labels, prediction, {0}, std::llround(1e6 * period), config).front();
  py::dict views;
  for (std::size_t view = 0; view < scoring::scored_views().size(); ++view) {
    const scoring::Score of_view = scoring::score_of_view(scored, view);
    py::dict metrics;
    for (const scoring::Metric& metric : scoring::metrics()) {
      metrics[metric.name.c_str()] = metric.of(of_view);
    }
    views[scoring::scored_views()[view].c_str()] = metrics;
  }
  return views;
}

/// What is implausible about a recording in memory, or about a log by path, which a mapping file
/// may convert.
std::vector<std::string> check(const py::object& log, const std::string& robot,
                               const std::optional<fs::path>& mapping) {
  const bool in_memory = py::hasattr(log, "info");
  if (in_memory && mapping) throw InputError("check: mapping is for logs by path");
  const auto recording = in_memory ? recording_of(log) : nullptr;
  const fs::path path = in_memory ? fs::path("recording") : path_of(log);
  return long_call([&](const std::atomic<bool>& stop) {
    logs::LogReader reader =
        in_memory ? logs::LogReader(logs::records_of(recording, &stop), path.string())
                  : logs::open_log(path, mapping.value_or(fs::path()), &stop);
    experiments::LogSteps steps(reader, nullptr, experiments::robot_of_file(robot));
    while (steps.next() != nullptr) {
    }
    std::vector<std::string> lines = reader.warnings();
    const std::vector<std::string> findings = steps.findings();
    lines.insert(lines.end(), findings.begin(), findings.end());
    return lines;
  });
}

}  // namespace

void add_runs(py::module_& module) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace)
  module.def("simulate", &simulate, "scenario"_a, "simulator"_a, "seed"_a, "run"_a,
             "assignments"_a);
  module.def("load", &load, "path"_a, "mapping"_a);
  module.def("save", &save, "arrays"_a, "info"_a, "path"_a);
  module.def("check", &check, "log"_a, "robot"_a, "mapping"_a);
  module.def("find_resource", &find_resource, "path"_a);
  module.def("simulators", [] { return simulators::simulator_names(); });
  module.def("contact_labels", &contact_labels, "normal_force"_a, "period"_a, "robot_mass"_a,
             "share"_a, "window"_a);
  module.def("score", &score, "beliefs"_a, "contact"_a, "period"_a, "skip"_a, "hold_off"_a,
             "takeoff_opens"_a, "landing_opens"_a, "minimum_flight"_a);
}

}  // namespace touchdown::python
