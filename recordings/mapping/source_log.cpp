#include "recordings/mapping/source_log.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "estimator/npz/npz.hpp"
#include "recordings/beliefs/numbers_csv.hpp"
#include "recordings/mapping/joint_columns.hpp"

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

/// Where the wanted columns are in the lines of a file.
class WantedColumns {
 public:
  /// Offers the columns of the file, and those that follow from joints' names, to the sink.
  void choose(const std::filesystem::path& path, const std::vector<std::string>& names,
              const SourceLogSink& sink) {
    SourceNames source{.file = path.string(), .names = names};
    joints_ = JointColumns::among(names);
    if (joints_) {
      for (std::string& name : first_joint_names(path, *joints_)) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        source.names.push_back(std::move(name));
        source.has_joint_names = true;
      }
    }
    bool needs_joints = false;
    for (const SourceColumn& column : sink.wanted(source)) {
      const auto found = std::find(names.begin(), names.end(), column.name);
      Wanted& one = wanted_.emplace_back();
      if (found == names.end()) {
        one.joint = column.name;
        needs_joints = true;
      } else {
        one.position = static_cast<std::size_t>(found - names.begin());
      }
    }
    if (!needs_joints) joints_.reset();
    row_.resize(wanted_.size());
  }

  bool needs(std::size_t column) const {
    return (joints_ && joints_->is_number(column)) ||
           std::any_of(wanted_.begin(), wanted_.end(),
                       [&](const Wanted& one) { return one.position == column; });
  }
  bool is_name(std::size_t column) const { return joints_ && joints_->is_name(column); }
  void set_name(std::size_t column, std::string_view name) { joints_->set_name(column, name); }

  /// The wanted numbers of a line.
  std::span<const double> in(std::span<const double> values) {
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const Wanted& one = wanted_[i];
      const auto position = one.position ? one.position : joints_->column_of(one.joint);
      row_[i] = position ? values[*position] : std::numeric_limits<double>::quiet_NaN();
    }
    return row_;
  }

 private:
  struct Wanted {
    std::optional<std::size_t> position;  ///< in a line
    std::string joint;                    ///< without a position: its column, by name
  };
  std::vector<Wanted> wanted_;
  std::optional<JointColumns> joints_;
  std::vector<double> row_;
};

void read_csv(const std::filesystem::path& path, const SourceLogSink& sink) {
  WantedColumns columns;
  NumbersCsvSink csv;
  csv.names = [&](std::span<const std::string> given) -> std::optional<ColumnError> {
    const std::vector<std::string> names(given.begin(), given.end());
    if (names == std::vector<std::string>{""}) return ColumnError{0, "expected a line of names"};
    columns.choose(path, names, sink);
    return std::nullopt;
  };
  csv.needs = [&](std::size_t column) { return columns.needs(column); };
  csv.has_text = [&](std::size_t column) { return columns.is_name(column); };
  csv.text = [&](std::size_t column, std::string_view text) { columns.set_name(column, text); };
  csv.empty_cell = std::numeric_limits<double>::quiet_NaN();
  csv.note = sink.note;
  csv.row = [&](std::span<const double> values, std::size_t line) -> std::optional<ColumnError> {
    sink.row(columns.in(values), [&] { return fmt::format("{}:{}", path.string(), line); });
    return std::nullopt;
  };
  read_numbers_csv(path, csv);
}

/// A column of an array: its first number, and the distance between numbers.
struct ArrayColumn {
  const double* first = nullptr;
  std::size_t stride = 1;
};

ArrayColumn column_of(const ModelArrays& arrays, const SourceColumn& column,
                      const std::filesystem::path& path) {
  const ModelArray& array = arrays.at(column.name);
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
    const ModelArrays one = read_npz(
        path, [&](std::string_view other) { return other == name ? any_array(other) : 0; });
    const auto found = one.find(name);
    return found != one.end() && found->second.shape.size() == 2 ? found->second.shape[1] : 1;
  };
  const std::vector<SourceColumn> wanted =
      sink.wanted({path.string(), true, npz_names(path), "", false, false, width});
  const ModelArrays arrays = read_npz(path, [&](std::string_view name) {
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
