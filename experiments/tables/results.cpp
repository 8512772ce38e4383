#include "experiments/tables/results.hpp"

#include <array>
#include <iterator>
#include <ostream>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/tables/verbs.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

namespace {

struct Unit {
  const char* ending;
  const char* unit;
};
/// The first match counts.
constexpr std::array units = {Unit{"_per_minute", "1/min"},
                              Unit{"_per_metre", "m/m"},
                              Unit{"_per_flight", "1/flight"},
                              Unit{"_per_nm", "1/(N·m)"},
                              Unit{"_ms", "ms"},
                              Unit{"_nm", "N·m"},
                              Unit{"_mps", "m/s"},
                              Unit{"_mps2", "m/s²"},
                              Unit{"_rad", "rad"},
                              Unit{"_bits", "bit"},
                              Unit{"_nats", "nat"},
                              Unit{"_m", "m"},
                              Unit{"_n", "N"},
                              Unit{"_s", "s"}};

/// The keys of one row by their names in long tables. `take` removes a key.
class Keys {
 public:
  void add(const std::string& name, const std::string& text) {
    if (!text.empty() && text != "nan") texts_.emplace_back(name, text);
  }

  std::string take(const std::string& name) {
    for (auto key = texts_.begin(); key != texts_.end(); ++key) {
      if (key->first != name) continue;
      std::string text = std::move(key->second);
      texts_.erase(key);
      return text;
    }
    return {};
  }

  /// A noise setting; knees and wheels have separate levels if there is no common one.
  std::string take_noise() {
    const std::string torque = take("torque_noise_nm");
    const std::string knee = take("knee_noise_nm");
    const std::string wheel = take("wheel_noise_nm");
    const std::string accelerometer = take("accelerometer_noise_mps2");
    if (accelerometer.empty()) return {};
    return torque.empty()
               ? fmt::format("knee {} N·m, wheel {} N·m, {} m/s²", knee, wheel, accelerometer)
               : fmt::format("{} N·m, {} m/s²", torque, accelerometer);
  }

  /// The keys that are left: "policy=soft_landing; value=0.7".
  std::string rest() const {
    std::string text;
    for (const auto& [name, key] : texts_) {
      text += fmt::format("{}{}={}", text.empty() ? "" : "; ", name, key);
    }
    return text;
  }

 private:
  std::vector<std::pair<std::string, std::string>> texts_;
};

std::string or_else(const std::string& text, const std::string& otherwise) {
  return text.empty() ? otherwise : text;
}

/// What all numbers of a line have in common. `metric` has the key that names the metric, if any.
ResultRow common_part(const std::string& study, const std::vector<std::string>& cells,
                      const std::vector<ColumnInfo>& columns, const ResultSetup& setup) {
  ResultRow row;
  row.study = study;
  Keys keys;
  std::size_t at = 0;
  for (const ColumnInfo& column : columns) {
    if (column.role == ColumnRole::key) keys.add(column.as, cells[at]);
    if (column.role == ColumnRole::runs) row.n = cells[at];
    at += column.has_bounds ? 3 : 1;
  }
  row.simulator = keys.take("simulator");
  row.robot = or_else(keys.take("robot"), setup.robot);
  row.sensors = or_else(keys.take("sensors"), setup.sensors);
  row.scene = keys.take("scene");
  row.estimator = keys.take("estimator");
  row.noise = keys.take_noise();
  row.metric = keys.take("metric");
  row.unit = keys.take("unit");
  row.setting = keys.rest();
  return row;
}

ResultSetup setup_of(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  const auto robots = unique(experiment.test.scenarios, [&](const std::string& file) {
    return scenario_of(request, file).scenario.robot.stem().string();
  });
  const std::filesystem::path sensors = experiment.sensors;
  return {robots.size() == 1 ? robots.front() : "",
          sensors.empty() ? "ideal" : sensors.stem().string()};
}

Columns<ResultRow> result_columns() {
  using Row = ResultRow;
  return Columns<Row>()
      .text("study", &Row::study)
      .text("simulator", &Row::simulator)
      .text("robot", &Row::robot)
      .text("sensors", &Row::sensors)
      .text("scene", &Row::scene)
      .text("estimator", &Row::estimator)
      .text("noise", &Row::noise)
      .text("metric", &Row::metric)
      .text("unit", &Row::unit)
      .text("n", &Row::n)
      .text("estimate", &Row::estimate)
      .text("low", &Row::low)
      .text("high", &Row::high)
      .text("setting", &Row::setting);
}

/// The numbers of one line of a table.
std::vector<ResultRow> rows_of_line(const std::string& study, const std::vector<std::string>& cells,
                                    const std::vector<ColumnInfo>& columns,
                                    const ResultSetup& setup) {
  std::vector<ResultRow> rows;
  const ResultRow common = common_part(study, cells, columns, setup);
  std::size_t at = 0;
  for (const ColumnInfo& column : columns) {
    if (column.role == ColumnRole::metric) {
      ResultRow& row = rows.emplace_back(common);
      row.metric =
          common.metric.empty() ? column.as : fmt::format("{}_of_{}", column.as, common.metric);
      row.unit = or_else(common.unit, unit_of(row.metric));
      row.estimate = cells[at];
      if (column.has_bounds) {
        row.low = cells[at + 1];
        row.high = cells[at + 2];
      }
    }
    at += column.has_bounds ? 3 : 1;
  }
  return rows;
}

}  // namespace

std::string unit_of(const std::string& metric) {
  for (const Unit& one : units) {
    if (metric.ends_with(one.ending)) return one.unit;
  }
  return {};
}

std::vector<ResultRow> long_rows(const std::string& study, const Table& table,
                                 const std::vector<ColumnInfo>& columns, const ResultSetup& setup) {
  std::vector<ResultRow> rows;
  for (const std::vector<std::string>& cells : table.rows) {
    std::vector<ResultRow> of_line = rows_of_line(study, cells, columns, setup);
    std::move(of_line.begin(), of_line.end(), std::back_inserter(rows));
  }
  return rows;
}

void write_results(const RunRequest& request, const RunDirectory& directory) {
  const ResultSetup setup = setup_of(request);
  const Columns<ResultRow> columns = result_columns();
  // Line by line: all rows at once would take ten times the memory of their text.
  const auto write = [&](std::ostream& stream) {
    stream << csv_line(columns.header());
    for (const std::string& name : directory.store().names(column_parts)) {
      const std::filesystem::path file = directory.file("tables", name);
      const auto of_table = directory.store().find<std::vector<ColumnInfo>>(column_parts, name);
      if (!of_table || !is_there(file)) continue;
      const Table table = from_csv(read_file(file));
      for (const std::vector<std::string>& cells : table.rows) {
        for (const ResultRow& row : rows_of_line(file.stem().string(), cells, *of_table, setup)) {
          stream << csv_line(columns.cells(row));
        }
      }
    }
  };
  write_stream_atomically(directory.own_file("tables", "results.csv"), write);
}

}  // namespace touchdown::experiments
