#include "recordings/mapping/source_log.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "recordings/beliefs/numbers_csv.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

namespace {

void read_csv(const std::filesystem::path& path, const SourceLogSink& sink) {
  std::vector<std::size_t> positions;  // of the wanted columns in a line
  std::vector<double> row;
  NumbersCsvSink csv;
  csv.names = [&](std::span<const std::string> given) -> std::optional<ColumnError> {
    const std::vector<std::string> names(given.begin(), given.end());
    if (names == std::vector<std::string>{""}) return ColumnError{0, "expected a line of names"};
    for (const SourceColumn& column : sink.wanted({path.string(), false, names})) {
      const auto found = std::find(names.begin(), names.end(), column.name);
      positions.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    row.resize(positions.size());
    return std::nullopt;
  };
  csv.needs = [&](std::size_t column) {
    return std::find(positions.begin(), positions.end(), column) != positions.end();
  };
  csv.empty_cell = std::numeric_limits<double>::quiet_NaN();
  csv.note = sink.note;
  csv.row = [&](std::span<const double> values, std::size_t line) -> std::optional<ColumnError> {
    for (std::size_t i = 0; i < positions.size(); ++i) row[i] = values[positions[i]];
    sink.row(row, [&] { return fmt::format("{}:{}", path.string(), line); });
    return std::nullopt;
  };
  read_numbers_csv(path, csv);
}

/// A column of an array: its first number, and the distance between numbers.
struct ArrayColumn {
  const double* first = nullptr;
  std::size_t stride = 1;
};

ArrayColumn column_of(const NpzArrays& arrays, const SourceColumn& column,
                      const std::filesystem::path& path) {
  const NpyArray& array = arrays.at(column.name);
  const std::size_t width = array.shape.size() == 2 ? array.shape[1] : 1;
  if (!column.index && width != 1) {
    throw InputError(fmt::format("{}: {}: has two axes ({}): expected 'index' to select a column",
                                 path.string(), column.name, fmt::join(array.shape, " × ")));
  }
  const std::size_t index = column.index.value_or(0);
  if (index >= width) {
    throw InputError(
        fmt::format("{}: {}: expected an array with two axes that has a column {}, "
                    "found one of {}",
                    path.string(), column.name, index, fmt::join(array.shape, " × ")));
  }
  return {array.data.data() + index, width};
}

void read_arrays(const std::filesystem::path& path, const SourceLogSink& sink) {
  const auto width = [&](const std::string& name) -> std::size_t {
    const NpzArrays one = read_npz(
        path, [&](std::string_view other) { return other == name ? any_array(other) : 0; });
    const auto found = one.find(name);
    return found != one.end() && found->second.shape.size() == 2 ? found->second.shape[1] : 1;
  };
  const std::vector<SourceColumn> wanted =
      sink.wanted({path.string(), true, npz_names(path), "", false, width});
  const NpzArrays arrays = read_npz(path, [&](std::string_view name) {
    const bool is_wanted = std::any_of(wanted.begin(), wanted.end(),
                                       [&](const SourceColumn& one) { return one.name == name; });
    return is_wanted ? any_array(name) : 0;
  });
  std::vector<ArrayColumn> columns;
  const std::string& first = wanted.front().name;
  const std::size_t rows = arrays.at(first).shape.front();
  for (const SourceColumn& column : wanted) {
    columns.push_back(column_of(arrays, column, path));
    const std::size_t size = arrays.at(column.name).shape.front();
    if (size != rows) {
      throw InputError(fmt::format("{}: {} has {} rows, and {} has {}", path.string(), column.name,
                                   size, first, rows));
    }
  }
  std::vector<double> row(columns.size());
  for (std::size_t k = 0; k < rows; ++k) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      row[i] = columns[i].first[k * columns[i].stride];
    sink.row(row, [&] { return fmt::format("{}: row {}", path.string(), k); });
  }
}

}  // namespace

void read_source_log(const std::filesystem::path& path, const SourceLogSink& sink) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".csv" || extension == ".tsv") {
    read_csv(path, sink);
  } else if (extension == ".npz") {
    read_arrays(path, sink);
  } else {
    throw InputError(
        fmt::format("{}: expected a log as FILE.csv or FILE.npz, or a ROS 2 bag", path.string()));
  }
}

}  // namespace touchdown::recordings
