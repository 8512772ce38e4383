#include "experiments/results/result_files.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <unistd.h>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <tbb/version.h>

#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/machine.hpp"
#include "core/resources.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/results/text_tables.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "logs/model_file.hpp"

namespace touchdown::experiments {

namespace {

using Json = nlohmann::ordered_json;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// The manifest of a run directory; an empty one if there is none that can be read.
Json manifest_in(const std::filesystem::path& run_directory) {
  const std::filesystem::path file = run_directory / "manifest.json";
  if (!is_there(file)) return Json::object();
  Json manifest = Json::parse(read_file(file), nullptr, false);
  return manifest.is_object() ? manifest : Json::object();
}

Json versions() {
  return {{"touchdown", TOUCHDOWN_VERSION},
          {"commit", build_commit()},
          {"build", build_fingerprint()},
          {"build_type", TOUCHDOWN_BUILD_TYPE},
          {"compiler", __VERSION__},
          {"mujoco", mj_versionString()},
          {"eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"onetbb", TBB_runtime_version()}};
}

/// What `written_estimators` reads.
Json python_estimators(const Experiment& experiment) {
  Json list = Json::array();
  for (const EstimatorEntry& entry : experiment.external_estimators) {
    if (!entry.name.starts_with(python_prefix)) continue;
    list.push_back({{"name", entry.name},
                    {"title", entry.title},
                    {"summary", entry.summary},
                    {"sensors", names_of(entry.sensors)},
                    {"source", entry.revision}});
  }
  return list;
}

Json failed_runs(const std::vector<FinishedRun>& runs) {
  Json list = Json::array();
  for (const FinishedRun& run : runs) {
    if (!run.failed()) continue;
    list.push_back({{"recording", run.plan.file},
                    {"outcome", logs::to_text(run.report.outcome)},
                    {"ending", run.report.ending}});
  }
  return list;
}

void write_models(const FittedModels& models, const RunDirectory& directory) {
  for (const auto& [key, by_estimator] : models) {
    for (const auto& [estimator, model] : by_estimator) {
      write_model_of(key, estimator, model, directory);
    }
  }
}

}  // namespace

Table runs_table(const std::vector<FinishedRun>& runs) {
  return Columns<FinishedRun>()
      .text("simulator", [](const FinishedRun& run) { return run.plan.simulator; })
      .text("scenario", [](const FinishedRun& run) { return run.plan.scenario.name; })
      .text("role", [](const FinishedRun& run) { return to_text(run.plan.role); })
      .number("run", [](const FinishedRun& run) { return run.plan.run; })
      .text("outcome",
            [](const FinishedRun& run) {
              return run.report.error.empty() ? logs::to_text(run.report.outcome) : "error";
            })
      .count("flights", [](const FinishedRun& run) { return run.report.flights; })
      .count("wheel_flights", [](const FinishedRun& run) { return run.report.wheel_flights; })
      .metric("duration_s", [](const FinishedRun& run) { return run.report.duration; })
      .table(runs);
}

namespace {

/// A file of LaTeX for each table, and all of the paper's in Markdown.
void write_text_tables(const ExperimentResult& result) {
  std::vector<CaptionedTable> tables = accuracy_tables(result);
  if (result.experiment.paper_tables) {
    std::string markdown;
    for (CaptionedTable& table : paper_tables(result)) {
      markdown += to_markdown(table) + "\n";
      tables.push_back(std::move(table));
    }
    write_atomically(result.directory.own_file("tables", "tables.md"), markdown);
  }
  for (const CaptionedTable& table : tables) {
    write_atomically(result.directory.own_file("tables", table.label + ".tex"), to_latex(table));
  }
}

}  // namespace

void write_model_of(const std::string& key, const std::string& estimator, const Model& model,
                    const RunDirectory& directory) {
  if (is_of_refit(key) || !has_numbers(model)) return;
  logs::save_model(model, directory.own_file("models", model_name(key, estimator)));
}

void write_result_files(const ExperimentResult& result) {
  write_models(result.models, result.directory);
  const RunDirectory& directory = result.directory;
  write_score_tables(result.tables, directory);
  write_text_tables(result);
}

std::map<std::string, std::string> table_digests(const std::filesystem::path& run_directory) {
  std::map<std::string, std::string> digests;
  for (const std::filesystem::path& name : own_files(run_directory)) {
    if (name.parent_path() != "tables") continue;
    digests[name.filename().string()] = file_fingerprint(run_directory / name);
  }
  return digests;
}

std::vector<std::string> edited_tables(const std::filesystem::path& run_directory) {
  std::vector<std::string> edited;
  const std::map<std::string, std::string> digests = table_digests(run_directory);
  const Json written = manifest_in(run_directory).value("tables", Json::object());
  for (const auto& [name, digest] : written.items()) {
    const auto now = digests.find(name);
    if (now != digests.end() && digest != now->second) edited.push_back(name);
  }
  return edited;
}

std::vector<std::string> config_warnings(const std::filesystem::path& run_directory) {
  const std::filesystem::path config = run_directory / "config.yaml";
  if (!is_there(config)) return {};
  const Json inputs = manifest_in(run_directory).value("inputs", Json::array());
  const auto written = std::ranges::find_if(inputs, [](const Json& input) {
    return input.is_object() && input.value("file", Json()) == "config.yaml";
  });
  const auto is_of = [&](const std::string& text) {
    return written->value("digest", Json()) == Fingerprint().add(text).text();
  };
  if (written == inputs.end() || is_of(read_file(config))) return {};
  // Comments and the order of keys do not count.
  const Experiment experiment =
      experiment_from_yaml(YamlDocument::load(config), written_estimators(run_directory));
  if (is_of(to_yaml(experiment))) return {};
  return {fmt::format(
      "{}: was edited since the run wrote it: its results are those of the configuration before",
      config.string())};
}

void write_manifest(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  Json json;
  json["experiment"] = experiment.name;
  json["id"] = result.id;
  json["command"] = result.provenance.command;
  json["heatmap"] = experiment.figures.heatmap;
  json["finished_at"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
  json["host"] = {{"name", host_name()},
                  {"cores", std::thread::hardware_concurrency()},
                  {"usable_cores", machine_share().processors},
                  {"processor", processor_class()},
                  {"threads", result.provenance.threads}};
  json["versions"] = versions();
  json["files"] = program_files().folder.string();
  json["seeds"] = {{"experiment", experiment.seed},
                   {"noise_seeds", experiment.noise.seeds},
                   {"bootstrap", experiment.intervals.bootstrap.seed}};
  json["timings_s"] = Json::object();
  for (const auto& [phase, seconds] : result.provenance.timings) json["timings_s"][phase] = seconds;
  json["failed_runs"] = failed_runs(result.runs);
  json["runs"] = result.runs.size();
  json["inputs"] = Json::array();
  for (const RequestInput& input : result.inputs) {
    json["inputs"].push_back({{"file", input.file}, {"digest", input.digest}});
  }
  const Json from_python = python_estimators(experiment);
  if (!from_python.empty()) json["python_estimators"] = from_python;
  json["tables"] = table_digests(result.directory.path());
  write_atomically(result.directory.own_file("", "manifest.json"),
                   json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace touchdown::experiments
