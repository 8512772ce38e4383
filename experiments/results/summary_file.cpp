#include "experiments/results/summary_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/results/result.hpp"
#include "experiments/run_directory/own_files.hpp"

namespace touchdown {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// JSON has null for undefined values.
double number_from(const Json& json) { return json.is_null() ? NAN : json.get<double>(); }

}  // namespace

// nlohmann::json finds these functions in the namespace of each type.

void to_json(Json& json, const Interval& interval) {
  json = {rounded(interval.estimate), rounded(interval.low), rounded(interval.high)};
}

void from_json(const Json& json, Interval& interval) {
  interval = {number_from(json.at(0)), number_from(json.at(1)), number_from(json.at(2))};
}

namespace noise {

void to_json(Json& json, const NoiseCell& cell) {
  json = {{"torque", cell.torque},
          {"accelerometer", cell.accelerometer},
          {"knee", cell.knee},
          {"wheel", cell.wheel}};
}

void from_json(const Json& json, NoiseCell& cell) {
  cell = {number_from(json.at("torque")), number_from(json.at("accelerometer")),
          number_from(json.at("knee")), number_from(json.at("wheel"))};
}

}  // namespace noise

namespace logs {

void to_json(Json& json, const Outcome& outcome) { json = to_text(outcome); }

void from_json(const Json& json, Outcome& outcome) {
  outcome = outcome_from_text(json.get<std::string>());
}

}  // namespace logs

namespace experiments {

NLOHMANN_JSON_SERIALIZE_ENUM(RunRole, {{RunRole::fit, "fit"}, {RunRole::test, "test"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(RunSummary, role, simulator, run, recording,
                                                outcome, flights, wheel_flights)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Condition, fit_simulator, test_simulator, estimator)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ScoreSummary, condition, cell, view, metric)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Difference, simulator, cell, first, second, metric)

void to_json(Json& json, const CellSummary& summary) {
  json = {{"condition", summary.condition},
          {"cell", summary.cell},
          {"always_contact", rounded(summary.always_contact)}};
  for (const PointMetric& metric : point_metrics) json[metric.name] = summary.*metric.interval;
}

void from_json(const Json& json, CellSummary& summary) {
  json.at("condition").get_to(summary.condition);
  json.at("cell").get_to(summary.cell);
  for (const PointMetric& metric : point_metrics) {
    json.at(metric.name).get_to(summary.*metric.interval);
  }
  summary.always_contact = number_from(json.at("always_contact"));
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Summary, runs, cells, scores, differences)

Summary summary_of(const ExperimentResult& result) {
  Summary summary{{}, result.summaries, result.scores, result.differences};
  for (const FinishedRun& run : result.runs) {
    summary.runs.push_back({run.plan.role, run.plan.simulator, run.plan.run, run.plan.file,
                            run.report.outcome, run.report.flights, run.report.wheel_flights});
  }
  return summary;
}

void write_summary(const Summary& summary, const fs::path& run_directory) {
  write_atomically(record_file(run_directory, "tables/summary.json"), Json(summary).dump() + "\n");
}

Summary read_summary(const fs::path& run_directory) {
  const fs::path file = run_directory / "tables/summary.json";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    throw InputError(
        fmt::format("{}: is not finished, or was made by an older touchdown: it has no "
                    "tables/summary.json; run "
                    "`touchdown run` again",
                    run_directory.string()));
  }
  Summary summary;
  try {
    summary = Json::parse(read_file(file)).get<Summary>();
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), reason_of(error)));
  }
  const auto has_all = [](const auto& row) {
    return row.metric.size() == scoring::metrics().size();
  };
  if (!std::all_of(summary.scores.begin(), summary.scores.end(), has_all) ||
      !std::all_of(summary.differences.begin(), summary.differences.end(), has_all)) {
    throw InputError(fmt::format("{}: has other metrics: run `touchdown run` again with this build",
                                 file.string()));
  }
  return summary;
}

nlohmann::ordered_json json_of(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const std::vector<Cell>& cells : table.rows) {
    nlohmann::ordered_json row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      auto& value = row[table.columns[i].name];
      if (const auto* const text = std::get_if<std::string>(&cells[i])) {
        value = *text;
      } else if (const auto* const count = std::get_if<std::int64_t>(&cells[i])) {
        value = static_cast<double>(*count);
      } else if (std::isfinite(std::get<double>(cells[i]))) {
        value = std::get<double>(cells[i]);
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string reason_of(const nlohmann::json::exception& error) {
  const std::string text = error.what();  // "[json.exception.type_error.302] type must be …"
  const std::size_t number_end = text.find("] ");
  return number_end == std::string::npos ? text : text.substr(number_end + 2);
}

}  // namespace experiments

}  // namespace touchdown
