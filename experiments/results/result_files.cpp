#include "experiments/results/result_files.hpp"

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
#include "estimator/evidence/channels.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/results/summary_file.hpp"
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

Json failed_runs(const std::vector<Rollout>& runs) {
  Json list = Json::array();
  for (const Rollout& run : runs) {
    if (!run.failed()) continue;
    list.push_back({{"recording", run.plan.file},
                    {"outcome", logs::to_text(run.report.outcome)},
                    {"ending", run.report.ending}});
  }
  return list;
}

/// The value of one evidence curve at one of its knots.
struct EvidencePoint {
  std::string simulator = {};
  std::string estimator = {};
  std::string targets = {};  ///< `targets_of` the set of curves
  std::string channel = {};
  std::string scale = {};  ///< ms; empty for noise levels
  std::string unit = {};   ///< of the value
  double value = 0.0;
  double evidence = 0.0;  ///< nats
};

/// The ends of the range of fitted rows, and the knots inside it.
std::set<float> knots_of(const std::array<float, 2>& seen) {
  std::set<float> knots = {seen[0], seen[1]};
  for (std::size_t k = 0; k < evidence_knots; ++k) {
    const float x = evidence_reach * (2.0F * static_cast<float>(k) / (evidence_knots - 1) - 1.0F);
    if (x > seen[0] && x < seen[1]) knots.insert(x);
  }
  return knots;
}

constexpr std::size_t first_noise = decision_channels * decision_scales;

/// The channel of an input that is no noise level; inputs as `curve_of` numbers curves.
const EvidenceChannel& channel_of(std::size_t input) {
  return input < decision_inputs ? evidence_channels[input / decision_scales]
                                 : servo_load_channels[(input - decision_inputs) / decision_scales];
}

bool is_noise_level(std::size_t input) { return input >= first_noise && input < decision_inputs; }

/// An input of the network: its channel's name, time scale and unit.
EvidencePoint input_of(std::size_t input) {
  if (is_noise_level(input)) {
    const std::size_t noise = input - first_noise;
    return {.channel = evidence_noise_names[noise], .unit = noise == 0 ? "N·m" : "m/s²"};
  }
  const EvidenceChannel& channel = channel_of(input);
  const std::size_t scale = input < decision_inputs ? input : input - decision_inputs;
  return {.channel = channel.name,
          .scale = std::to_string(1U << (scale % decision_scales)),
          .unit = channel.unit};
}

/// An input in the unit of its channel.
double in_unit(std::size_t input, double x) {
  if (is_noise_level(input)) return std::exp(x);
  return uncompressed(x, static_cast<double>(channel_of(input).softsign_scale));
}

/// Adds the points of one set of curves.
void add_points(const EvidenceModel& model, const EvidencePoint& of_fit,
                std::vector<EvidencePoint>& points) {
  for (std::size_t input = 0; input < curve_count(model); ++input) {
    for (const float x : knots_of(seen_by(model, input))) {
      EvidencePoint& point = points.emplace_back(input_of(input));
      point.simulator = of_fit.simulator;
      point.estimator = of_fit.estimator;
      point.targets = targets_of(model);
      point.value = in_unit(input, static_cast<double>(x));
      point.evidence = static_cast<double>(evidence_at(curve_of(model, input), x));
    }
  }
}

/// The columns of `evidence.csv`.
Columns<EvidencePoint> evidence_columns() {
  using Point = EvidencePoint;
  return Columns<Point>()
      .text("simulator", &Point::simulator)
      .text("estimator", &Point::estimator)
      .text("targets", &Point::targets)
      .text("channel", &Point::channel)
      .text("scale_ms", &Point::scale)
      .text("unit", &Point::unit)
      .metric("value", &Point::value)
      .metric("evidence_nats", &Point::evidence);
}

void write_models(const FittedModels& models, const RunDirectory& directory) {
  for (const auto& [key, by_estimator] : models) {
    for (const auto& [estimator, model] : by_estimator) {
      write_model_of(key, estimator, model, directory);
    }
  }
}

Columns<Rollout> run_columns() {
  return Columns<Rollout>()
      .text("simulator", [](const Rollout& run) { return run.plan.simulator; })
      .text("scenario", [](const Rollout& run) { return run.plan.scenario.name; })
      .text("role", [](const Rollout& run) { return to_text(run.plan.role); })
      .number("run", [](const Rollout& run) { return run.plan.run; })
      .text("outcome",
            [](const Rollout& run) {
              return run.report.error.empty() ? logs::to_text(run.report.outcome) : "error";
            })
      .count("flights", [](const Rollout& run) { return run.report.flights; })
      .count("wheel_flights", [](const Rollout& run) { return run.report.wheel_flights; })
      .metric("duration_s", [](const Rollout& run) { return run.report.duration; });
}

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

Table evidence_table(const FittedModels& models) {
  std::vector<EvidencePoint> points;
  for (const auto& [simulator, by_estimator] : models) {
    if (is_of_refit(simulator)) continue;
    for (const auto& [estimator, fitted] : by_estimator) {
      const std::optional<EvidenceCurveSets> sets = evidence_in(fitted);
      if (!sets) continue;
      const EvidencePoint of_fit = {.simulator = simulator, .estimator = estimator};
      add_points(sets->usual, of_fit, points);
      if (sets->without_targets) add_points(*sets->without_targets, of_fit, points);
    }
  }
  return evidence_columns().table(points);
}

void write_model_of(const std::string& key, const std::string& estimator, const Model& model,
                    const RunDirectory& directory) {
  if (is_of_refit(key) || !has_numbers(model)) return;
  logs::save_model(model, directory.own_file("models", model_name(key, estimator)));
}

void write_result_files(const ExperimentResult& result) {
  write_models(result.models, result.directory);
  const RunDirectory& directory = result.directory;
  const Table evidence = evidence_table(result.models);
  if (!evidence.rows.empty()) directory.write_table("evidence.csv", evidence);
  directory.write_table("runs.csv", run_columns().table(result.runs));
  write_score_tables(result.summaries, result.scores, result.differences, directory);
  write_text_tables(result);
  write_summary(summary_of(result), result.directory.path());
}

std::map<std::string, std::string> table_digests(const std::filesystem::path& run_directory) {
  std::map<std::string, std::string> digests;
  for (const std::filesystem::path& name : own_files(run_directory)) {
    if (name.parent_path() != "tables") continue;
    digests[name.filename().string()] = file_fingerprint(run_directory / name);
  }
  return digests;
}

void write_manifest(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  Json json;
  json["experiment"] = experiment.name;
  json["id"] = result.id;
  json["command"] = result.provenance.command;
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
  write_atomically(result.directory.path() / "manifest.json",
                   json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace touchdown::experiments
