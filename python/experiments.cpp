#include "python/experiments.hpp"

#include <filesystem>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <utility>

#include "core/resources.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "python/external_estimators.hpp"
#include "python/long_call.hpp"

namespace touchdown::python {

namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// An experiment as given by a caller: a file, or the text of one.
struct ExperimentRequest {
  fs::path file;
  std::optional<std::string> text;
  std::vector<std::string> assignments;
};

YamlDocument document_of(const ExperimentRequest& request) {
  YamlDocument document = request.text ? YamlDocument::parse(*request.text, request.file)
                                       : YamlDocument::load(find_resource(request.file));
  for (const std::string& assignment : request.assignments) document.override_value(assignment);
  experiments::require_yaml_kind(document, experiments::YamlKind::experiment);
  return document;
}

/// Names of an experiment's estimators that are written in Python, each with its place in the file.
std::vector<std::pair<std::string, std::string>> python_estimators(
    const ExperimentRequest& request) {
  std::vector<std::pair<std::string, std::string>> names;
  const YamlDocument document = document_of(request);
  const YAML::Node given = document.root()["estimators"];
  if (!given || !given.IsSequence()) return names;
  for (const auto& item : given) {
    if (item.IsScalar() && item.Scalar().starts_with(experiments::python_prefix)) {
      names.emplace_back(item.Scalar(), document.place_of(item, "estimators"));
    }
  }
  return names;
}

struct Finished {
  fs::path directory;
  std::string id;
  std::vector<std::string> studies;
  std::vector<std::string> failed_demands;
};

py::dict run(const ExperimentRequest& request, const fs::path& out, bool overwrite,
             const std::string& command, const py::list& external_estimators) {
  const std::vector<experiments::EstimatorEntry> external =
      external_estimators_of(external_estimators);
  const Finished finished = long_call([&](const std::atomic<bool>& stop) {
    const YamlDocument document = document_of(request);
    const experiments::Experiment experiment =
        experiments::experiment_from_yaml(document, external);
    experiments::require_files(document);
    const experiments::ExperimentResult result = experiments::run_experiment(
        experiment, {.out = out, .command = command, .stop = &stop, .overwrite = overwrite});
    return Finished{result.directory.path(), result.id, result.studies, result.failed_demands};
  });
  py::dict about;
  about["path"] = finished.directory;
  about["id"] = finished.id;
  about["studies"] = finished.studies;
  about["failed_demands"] = finished.failed_demands;
  return about;
}

}  // namespace

void add_experiments(py::module_& module) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace)
  module.def(
      "python_estimators",
      [](const fs::path& experiment, const std::optional<std::string>& text,
         const std::vector<std::string>& assignments) {
        return python_estimators({experiment, text, assignments});
      },
      "experiment"_a, "text"_a, "assignments"_a);
  module.def(
      "run",
      [](const fs::path& experiment, const std::optional<std::string>& text,
         const std::vector<std::string>& assignments, const fs::path& out, bool overwrite,
         const std::string& command, const py::list& external_estimators) {
        return run({experiment, text, assignments}, out, overwrite, command, external_estimators);
      },
      "experiment"_a, "text"_a, "assignments"_a, "out"_a, "overwrite"_a, "command"_a,
      "external_estimators"_a);
}

}  // namespace touchdown::python
