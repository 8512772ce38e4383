#include "experiments/results/samples.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <ostream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/files.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;
using scoring::Classification;

struct NamedCount {
  const char* name;
  std::int64_t Classification::*count;
};
constexpr std::array named_counts = {
    NamedCount{"contact_as_contact", &Classification::contact_as_contact},
    NamedCount{"contact_as_flight", &Classification::contact_as_flight},
    NamedCount{"flight_as_contact", &Classification::flight_as_contact},
    NamedCount{"flight_as_flight", &Classification::flight_as_flight}};

/// A row of the table.
struct SampleRow {
  const Condition* condition;
  const noise::NoiseCell* noise;
  SampleKey key;
  Classification counts;
};

Columns<SampleRow> sample_columns() {
  const auto noise = [](const SampleRow& row) -> const noise::NoiseCell& { return *row.noise; };
  Columns<SampleRow> columns;
  columns.text("simulator", [](const SampleRow& row) { return row.condition->test_simulator; })
      .text("fit_simulator", [](const SampleRow& row) { return row.condition->fit_simulator; })
      .text("estimator", [](const SampleRow& row) { return row.condition->estimator; })
      .part(noise, noise_columns())
      .part(noise, knee_wheel_columns())
      .text("scenario", [](const SampleRow& row) { return row.key.scenario; })
      .number("run", [](const SampleRow& row) { return row.key.run; })
      .number("segment", [](const SampleRow& row) { return row.key.segment; });
  for (const NamedCount& one : named_counts) {
    columns.count(one.name,
                  [count = one.count](const SampleRow& row) { return row.counts.*count; });
  }
  return columns;
}

/// The numbers of a table that an older or newer build wrote, or a user edited.
class SampleTable {
 public:
  explicit SampleTable(const fs::path& file) : file_(file), table_(from_csv(read_file(file))) {}

  std::size_t rows() const { return table_.rows.size(); }

  /// The place of a column. Errors: `InputError` without it.
  std::size_t column(std::string_view name) const {
    const auto found = std::find(table_.header.begin(), table_.header.end(), name);
    if (found == table_.header.end()) {
      throw InputError(fmt::format("{}:1: expected a column '{}'", file_.string(), name));
    }
    return static_cast<std::size_t>(found - table_.header.begin());
  }

  const std::string& text(std::size_t row, std::size_t column) const {
    return table_.rows[row][column];
  }

  /// Errors: `InputError` for a cell that is no non-negative number of this type.
  template <typename Number>
  Number number(std::size_t row, std::size_t column) const {
    const std::string& cell = text(row, column);
    Number value = {};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !(value >= Number{})) {
      throw InputError(fmt::format("{}: row {}: {}: expected a number of at least 0, found '{}'",
                                   file_.string(), row + 1, table_.header[column], cell));
    }
    return value;
  }

 private:
  fs::path file_;
  TextTable table_;
};

/// The cells of a table, in its order.
std::vector<SampledCell> cells_of(const SampleTable& table) {
  const std::size_t simulator = table.column("simulator");
  const std::size_t fit_simulator = table.column("fit_simulator");
  const std::size_t estimator = table.column("estimator");
  const std::size_t knee = table.column("knee_noise_nm");
  const std::size_t wheel = table.column("wheel_noise_nm");
  const std::size_t accelerometer = table.column("accelerometer_noise_mps2");
  const std::size_t scenario = table.column("scenario");
  const std::size_t run = table.column("run");
  const std::size_t segment = table.column("segment");
  std::array<std::size_t, named_counts.size()> counts = {};
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = table.column(named_counts[i].name);

  std::vector<SampledCell> cells;
  std::map<std::vector<std::string>, std::size_t> places;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> key;
    for (const std::size_t column :
         {simulator, fit_simulator, estimator, knee, wheel, accelerometer})
      key.push_back(table.text(row, column));
    const auto [place, is_new] = places.emplace(std::move(key), cells.size());
    if (is_new) {
      cells.push_back(
          {{.fit_simulator = table.text(row, fit_simulator),
            .test_simulator = table.text(row, simulator),
            .estimator = table.text(row, estimator)},
           noise::knee_wheel_cell(table.number<double>(row, knee), table.number<double>(row, wheel),
                                  table.number<double>(row, accelerometer))});
    }
    Classification& sample =
        cells[place->second]
            .samples[{table.text(row, scenario), table.number<std::int64_t>(row, run),
                      table.number<std::int64_t>(row, segment)}];
    for (std::size_t i = 0; i < counts.size(); ++i) {
      sample.*named_counts[i].count += table.number<std::int64_t>(row, counts[i]);
    }
  }
  return cells;
}

/// The section `intervals` alone: this build may not know other keys of the experiment.
scoring::BootstrapConfig bootstrap_in(const fs::path& config) {
  const YamlDocument document = YamlDocument::load(config);
  scoring::IntervalConfig intervals;
  if (document.root().IsMap() && document.root()["intervals"]) {
    const YamlDocument section = YamlDocument::parse(YAML::Dump(document.root()["intervals"]),
                                                     config.string() + ": intervals");
    Fields fields(section);
    describe(fields, intervals);
  }
  return intervals.bootstrap;
}

}  // namespace

void write_samples(const CollectedCounts& counts, const Plan& plan, const RunDirectory& directory) {
  const std::vector<noise::NoiseCell>& cells = plan.groups.front().counted;
  const Columns<SampleRow> columns = sample_columns();
  const auto write_cell = [&](const ConditionCounts& one, std::size_t cell, std::ostream& file) {
    std::vector<SampleRow> rows;
    for (const SampleOrigin& origin : counts.origins.at(one.condition.test_simulator)) {
      const PlannedRun& run = plan.runs[origin.run];
      rows.push_back({&one.condition,
                      &cells[cell],
                      {run.scenario.name, run.run, static_cast<std::int64_t>(origin.segment)},
                      one.samples[cell][rows.size()]});
    }
    const std::string csv = to_csv(columns.table(rows));
    file << std::string_view(csv).substr(csv.find('\n') + 1);
  };
  // Cell by cell: of a large study all rows at once would take more memory than the study itself.
  write_stream_atomically(directory.own_file("tables", "samples.csv"), [&](std::ostream& file) {
    file << to_csv(columns.table(std::vector<SampleRow>()));
    for (const ConditionCounts& one : counts.counted) {
      if (!one.condition.fit.empty() || !counts.origins.contains(one.condition.test_simulator)) {
        continue;
      }
      for (std::size_t cell = 0; cell < cells.size(); ++cell) write_cell(one, cell, file);
    }
  });
}

SampledRun read_samples(const fs::path& run_directory) {
  const fs::path config = run_directory / "config.yaml";
  if (!is_there(config)) {
    throw InputError(fmt::format("{}: no run directory of an experiment: it has no config.yaml",
                                 run_directory.string()));
  }
  const fs::path table = run_directory / "tables" / "samples.csv";
  if (!is_there(table)) {
    throw InputError(
        fmt::format("{}: is not finished, or was made by an older touchdown: it has no "
                    "tables/samples.csv; run it again, or `touchdown merge` its shards",
                    run_directory.string()));
  }
  return {run_directory.string(), cells_of(SampleTable(table)), bootstrap_in(config)};
}

}  // namespace touchdown::experiments
