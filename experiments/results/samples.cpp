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

using SampleRow = Scored<Classification>;

Columns<SampleRow> sample_columns() {
  const auto noise = [](const SampleRow& row) -> const noise::NoiseCell& { return *row.noise; };
  Columns<SampleRow> columns;
  columns.text("simulator", [](const SampleRow& row) { return row.condition->test_simulator; })
      .text("fit_simulator", [](const SampleRow& row) { return row.condition->fit_simulator; })
      .text("estimator", [](const SampleRow& row) { return row.condition->estimator; })
      .part(noise, noise_columns())
      .part(noise, knee_wheel_columns())
      .text("scenario", [](const SampleRow& row) { return row.run->scenario.name; })
      .number("run", [](const SampleRow& row) { return row.run->run; })
      .number("segment", &SampleRow::segment);
  for (const NamedCount& one : named_counts) {
    columns.count(one.name, [count = one.count](const SampleRow& row) { return row.score.*count; });
  }
  return columns;
}

/// Whether all of a text is a number of at least 0.
template <typename Number>
bool is_number(const std::string& text) {
  Number number{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last && number >= 0;
}

/// A table that an older or newer build wrote, or a user edited. Errors: `InputError` for a column
/// that is missing, and for a cell that is no number of at least 0 of its column's type.
Table read_table(const fs::path& file) {
  const TextTable texts = from_csv(read_file(file));
  const Columns<SampleRow> columns = sample_columns();
  for (const Column& column : columns.list()) {
    if (column.name == "torque_noise_nm") continue;  // NaN where those of knees and wheels differ
    if (std::ranges::find(texts.header, column.name) == texts.header.end()) {
      throw InputError(fmt::format("{}:1: expected a column '{}'", file.string(), column.name));
    }
    if (column.type == ColumnType::text) continue;
    for (std::size_t row = 0; row < texts.rows.size(); ++row) {
      const std::string text = cell(texts, texts.rows[row], column.name);
      const bool is_count = column.type == ColumnType::count;
      if (is_count ? is_number<std::int64_t>(text) : is_number<double>(text)) continue;
      throw InputError(fmt::format("{}: row {}: {}: expected a number of at least 0, found '{}'",
                                   file.string(), row + 1, column.name, text));
    }
  }
  return table_of(texts, columns.list());
}

/// The cells of a table, in its order.
std::vector<SampledCell> cells_of(const Table& table) {
  std::vector<SampledCell> cells;
  std::map<std::vector<std::string>, std::size_t> places;
  const Table keys = select(table, {"simulator", "fit_simulator", "estimator", "knee_noise_nm",
                                    "wheel_noise_nm", "accelerometer_noise_mps2"});
  const auto whole = [](double number) { return static_cast<std::int64_t>(number); };
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const TableRow row(table, i);
    const auto [place, is_new] = places.emplace(TableRow(keys, i).texts(), cells.size());
    if (is_new) {
      cells.push_back(
          {{.fit_simulator = row.text("fit_simulator"),
            .test_simulator = row.text("simulator"),
            .estimator = row.text("estimator")},
           noise::knee_wheel_cell(row.number("knee_noise_nm"), row.number("wheel_noise_nm"),
                                  row.number("accelerometer_noise_mps2"))});
    }
    Classification& sample = cells[place->second].samples[{
        row.text("scenario"), whole(row.number("run")), whole(row.number("segment"))}];
    for (const NamedCount& one : named_counts) sample.*one.count += whole(row.number(one.name));
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

void write_samples(const std::vector<SampleRow>& rows, const RunDirectory& directory) {
  const Columns<SampleRow> columns = sample_columns();
  // Cell by cell: of a large study all rows at once would take more memory than the study itself.
  write_stream_atomically(directory.own_file("tables", "samples.csv"), [&](std::ostream& file) {
    file << to_csv(columns.table(std::vector<SampleRow>()));
    for (auto row = rows.begin(); row != rows.end();) {
      std::vector<SampleRow> alike;
      const auto first = row;
      for (; row != rows.end() && row->condition == first->condition && row->noise == first->noise;
           ++row) {
        if (row->run != nullptr && row->condition->fit.empty()) alike.push_back(*row);
      }
      const std::string csv = to_csv(columns.table(alike));
      file << std::string_view(csv).substr(csv.find('\n') + 1);
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
                    "tables/samples.csv; `touchdown run` it again",
                    run_directory.string()));
  }
  return {run_directory.string(), cells_of(read_table(table)), bootstrap_in(config)};
}

}  // namespace touchdown::experiments
