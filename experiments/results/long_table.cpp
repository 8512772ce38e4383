#include "experiments/results/long_table.hpp"

#include <array>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/rows.hpp"

namespace touchdown::experiments {

namespace {

struct Unit {
  const char* ending;
  const char* unit;
};
/// The first match counts.
constexpr std::array units = {Unit{"_s_per_minute", "s/min"},
                              Unit{"_per_minute", "1/min"},
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

ResultSetup setup_of(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  const auto robots = unique(experiment.test.scenarios, [&](const std::string& file) {
    return scenario_of(request, file).scenario.robot.stem().string();
  });
  const std::filesystem::path sensors = experiment.sensors;
  return {robots.size() == 1 ? robots.front() : "",
          sensors.empty() ? "ideal" : sensors.stem().string()};
}

}  // namespace

std::string unit_of(const std::string& metric) {
  for (const Unit& one : units) {
    if (metric.ends_with(one.ending)) return one.unit;
  }
  return {};
}

std::vector<std::vector<std::string>> long_rows(const std::string& study, const Table& table,
                                                std::size_t index, const ResultSetup& setup) {
  const std::vector<std::string> line = TableRow(table, index).texts();
  Keys keys;
  std::string runs;
  const std::vector<Column>& columns = table.columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].role == ColumnRole::key) keys.add(columns[i].as, line[i]);
    if (columns[i].role == ColumnRole::runs) runs = line[i];
  }
  std::vector<std::string> common = {study, keys.take("simulator")};
  common.push_back(or_else(keys.take("robot"), setup.robot));
  common.push_back(or_else(keys.take("sensors"), setup.sensors));
  for (const char* key : {"scene", "estimator"}) common.push_back(keys.take(key));
  common.push_back(keys.take_noise());
  const std::string named = keys.take("metric");
  const std::string unit = keys.take("unit");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].role != ColumnRole::metric) continue;
    const std::string metric =
        named.empty() ? columns[i].as : fmt::format("{}_of_{}", columns[i].as, named);
    std::vector<std::string>& row = rows.emplace_back(common);
    row.insert(row.end(), {metric, or_else(unit, unit_of(metric)), runs, line[i]});
    const bool has_bounds = i + 1 < columns.size() && columns[i + 1].role == ColumnRole::low;
    for (const std::size_t bound : {i + 1, i + 2}) row.push_back(has_bounds ? line[bound] : "");
    row.push_back(keys.rest());
  }
  return rows;
}

void write_results(const RunRequest& request, const RunDirectory& directory) {
  const ResultSetup setup = setup_of(request);
  // Line by line: all rows at once would take ten times the memory of their text.
  const auto write = [&](std::ostream& stream) {
    stream << csv_line(long_header);
    for (const std::string& name : directory.store().names(column_parts)) {
      if (!is_there(directory.file("tables", name))) continue;
      const Table& table = directory.read_table(name);
      const std::string study = std::filesystem::path(name).stem().string();
      for (std::size_t line = 0; line < table.rows.size(); ++line) {
        for (const auto& row : long_rows(study, table, line, setup)) stream << csv_line(row);
      }
    }
  };
  write_stream_atomically(directory.own_file("tables", "results.csv"), write);
}

}  // namespace touchdown::experiments
