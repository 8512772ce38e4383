#include "recordings/mapping/source_log.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "recordings/beliefs/numbers_csv.hpp"
#include "recordings/mapping/joint_columns.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

namespace {

/// The columns that the names of joints in the first row with names give.
std::vector<std::string> first_joint_names(const std::filesystem::path& path, JointColumns joints) {
  struct Done {};
  NumbersCsvSink csv;
  csv.names = [](std::span<const std::string>) { return std::nullopt; };
  csv.needs = [](std::size_t) { return false; };
  csv.has_text = [&](std::size_t column) { return joints.is_name(column); };
  csv.text = [&](std::size_t column, std::string_view text) { joints.set_name(column, text); };
  csv.note = [](const std::string&) {};
  csv.row = [&](std::span<const double>, std::size_t) -> std::optional<ColumnError> {
    if (!joints.names().empty()) throw Done{};
    return std::nullopt;
  };
  try {
    read_numbers_csv(path, csv);
  } catch (const Done&) {  // NOLINT(bugprone-empty-catch): the names suffice
  }
  return joints.names();
}

void read_csv(const std::filesystem::path& path, const SourceLogSink& sink) {
  // The position in a line of a wanted column, or its name if it follows from a joint's name.
  struct WantedColumn {
    std::optional<std::size_t> position;
    std::string joint;
  };
  std::vector<WantedColumn> wanted;
  std::optional<JointColumns> joints;
  std::vector<double> row;
  NumbersCsvSink csv;
  csv.names = [&](std::span<const std::string> given) -> std::optional<ColumnError> {
    const std::vector<std::string> names(given.begin(), given.end());
    if (names == std::vector<std::string>{""}) return ColumnError{0, "expected a line of names"};
    std::vector<std::string> all = names;
    joints = JointColumns::among(names);
    if (joints) {
      for (std::string& name : first_joint_names(path, *joints)) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
          all.push_back(std::move(name));
        }
      }
    }
    const bool has_joint_names = all.size() > names.size();
    SourceNames source{.file = path.string(), .names = std::move(all)};
    source.has_joint_names = has_joint_names;
    for (const SourceColumn& column : sink.wanted(source)) {
      const auto found = std::find(names.begin(), names.end(), column.name);
      if (found == names.end()) {
        wanted.push_back({std::nullopt, column.name});
      } else {
        wanted.push_back({static_cast<std::size_t>(found - names.begin()), ""});
      }
    }
    const bool are_columns = std::all_of(wanted.begin(), wanted.end(), [](const auto& column) {
      return column.position.has_value();
    });
    if (are_columns) joints.reset();
    row.resize(wanted.size());
    return std::nullopt;
  };
  csv.needs = [&](std::size_t column) {
    return (joints && joints->is_number(column)) ||
           std::any_of(wanted.begin(), wanted.end(),
                       [&](const WantedColumn& one) { return one.position == column; });
  };
  csv.has_text = [&](std::size_t column) { return joints && joints->is_name(column); };
  csv.text = [&](std::size_t column, std::string_view text) { joints->set_name(column, text); };
  csv.empty_cell = std::numeric_limits<double>::quiet_NaN();
  csv.note = sink.note;
  csv.row = [&](std::span<const double> values, std::size_t line) -> std::optional<ColumnError> {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto position =
          wanted[i].position ? wanted[i].position : joints->column_of(wanted[i].joint);
      row[i] = position ? values[*position] : std::numeric_limits<double>::quiet_NaN();
    }
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
      sink.wanted({path.string(), true, npz_names(path), "", false, false, width});
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
