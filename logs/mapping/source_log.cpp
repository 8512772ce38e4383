#include "logs/mapping/source_log.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
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
#include "logs/log/numbers_csv.hpp"

namespace touchdown::logs {

namespace {

/// The columns of a sensor_msgs/JointState in a CSV file, as programs write its lists: name[0],
/// position[0], velocity[0], effort[0], name[1], … A joint is found by the name in its row, as in a
/// bag: as a column NAME/position, NAME/velocity or NAME/effort.
class JointColumns {
 public:
  /// The lists among these columns, if there is one of names. Before a list's name there may be
  /// those of its message (field.name0); its index may be in brackets, or behind a dot, a slash or
  /// an underscore.
  static std::optional<JointColumns> among(std::span<const std::string> columns);

  bool is_name(std::size_t column) const;
  bool is_number(std::size_t column) const;

  /// Sets the text of a column of names in the present row.
  void set_name(std::size_t column, std::string_view name);
  /// The columns that the joints of the present row have, by name.
  std::vector<std::string> names() const;
  /// Where the number of a joint's column is in the present row; nothing if the row lacks it.
  std::optional<std::size_t> column_of(std::string_view joint_column) const;

 private:
  struct Joint {
    std::size_t name_column = 0;
    std::array<std::optional<std::size_t>, 3> numbers;  ///< position, velocity, effort
    std::string name;                                   ///< in the present row
  };
  std::vector<Joint> joints_;
};

constexpr std::array<std::string_view, 3> joint_fields = {"position", "velocity", "effort"};

/// Whether this is how an index is written behind a list's name: [0], .0, /0, _0 or 0.
bool is_index(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) {
    text = text.substr(1, text.size() - 2);
  } else if (text.starts_with('.') || text.starts_with('/') || text.starts_with('_')) {
    text.remove_prefix(1);
  }
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<JointColumns> JointColumns::among(std::span<const std::string> columns) {
  JointColumns found;
  constexpr std::string_view list = "name";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& column = columns[i];
    const std::size_t at = column.rfind(list);
    if (at == std::string::npos || !is_index(std::string_view(column).substr(at + list.size()))) {
      continue;
    }
    const bool begins_word = at == 0 || column[at - 1] == '.' || column[at - 1] == '/';
    if (!begins_word) continue;
    Joint joint{.name_column = i, .numbers = {}, .name = {}};
    for (std::size_t f = 0; f < joint_fields.size(); ++f) {
      std::string number = column;
      number.replace(at, list.size(), joint_fields.at(f));
      const auto of_number = std::find(columns.begin(), columns.end(), number);
      if (of_number == columns.end()) continue;
      joint.numbers.at(f) = static_cast<std::size_t>(of_number - columns.begin());
    }
    const bool has_numbers = std::any_of(joint.numbers.begin(), joint.numbers.end(),
                                         [](const auto& number) { return number.has_value(); });
    if (has_numbers) found.joints_.push_back(std::move(joint));
  }
  return found.joints_.empty() ? std::nullopt : std::optional(std::move(found));
}

bool JointColumns::is_name(std::size_t column) const {
  return std::any_of(joints_.begin(), joints_.end(),
                     [&](const Joint& joint) { return joint.name_column == column; });
}

bool JointColumns::is_number(std::size_t column) const {
  return std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
    return std::find(joint.numbers.begin(), joint.numbers.end(), column) != joint.numbers.end();
  });
}

void JointColumns::set_name(std::size_t column, std::string_view name) {
  for (Joint& joint : joints_) {
    if (joint.name_column == column) joint.name = name;
  }
}

std::vector<std::string> JointColumns::names() const {
  std::vector<std::string> names;
  for (const Joint& joint : joints_) {
    for (std::size_t f = 0; f < joint_fields.size(); ++f) {
      if (joint.name.empty() || !joint.numbers.at(f)) continue;
      names.push_back(joint.name + '/' + std::string(joint_fields.at(f)));
    }
  }
  return names;
}

std::optional<std::size_t> JointColumns::column_of(std::string_view joint_column) const {
  for (const Joint& joint : joints_) {
    const std::size_t size = joint.name.size();
    if (size == 0 || joint_column.size() <= size || !joint_column.starts_with(joint.name) ||
        joint_column[size] != '/') {
      continue;
    }
    const auto* const field =
        std::find(joint_fields.begin(), joint_fields.end(), joint_column.substr(size + 1));
    if (field != joint_fields.end())
      return joint.numbers.at(static_cast<std::size_t>(field - joint_fields.begin()));
  }
  return std::nullopt;
}

}  // namespace

RowHold::RowHold(const LogMapping& mapping) {
  for (const MappedSignal* signal : {&mapping.position, &mapping.velocity, &mapping.torque}) {
    add(*signal, true);
  }
  if (mapping.leg_targets) {
    add(mapping.leg_targets->position, true);
    if (mapping.leg_targets->velocity) add(*mapping.leg_targets->velocity, true);
    if (mapping.leg_targets->torque) add(*mapping.leg_targets->torque, true);
  }
  if (!mapping.clocks.empty()) return;  // the others have sources of their own (SourceJoin)
  add(mapping.orientation, false);
  add(mapping.angular_velocity, false);
  if (mapping.linear_acceleration) add(*mapping.linear_acceleration, false);
  if (mapping.proper_acceleration) add(*mapping.proper_acceleration, false);
}

void RowHold::add(const MappedSignal& signal, bool is_of_joint) {
  for (const MappedSignal::Number& number : signal.numbers) {
    if (number.column != MappedSignal::no_column) held_.push_back({number.column, is_of_joint});
  }
}

bool RowHold::complete(std::span<double> row, double time) {
  bool has_joint = false;
  bool has_other = false;
  bool is_completed = false;
  double oldest = 0.0;
  for (Held& held : held_) {
    double& number = row[held.column];
    if (!std::isnan(number)) {
      (held.is_of_joint ? has_joint : has_other) = true;
      held.last = {number, std::isfinite(time) ? time : held.last.time};
      continue;
    }
    const std::optional<double> age = held.last.age(time);
    if (!age) continue;
    number = held.last.value;
    is_completed = true;
    oldest = std::max(oldest, *age);
  }
  if (!has_joint && has_other) {
    ++without_joints_;
    return false;
  }
  if (is_completed) {
    ++completed_;
    oldest_ = std::max(oldest_, oldest);
  }
  return true;
}

namespace {

/// The columns that the names of joints in the first row with names give.
std::vector<std::string> first_joint_names(const std::filesystem::path& path, JointColumns joints) {
  NumbersCsvSink csv;
  csv.names = [](std::span<const std::string>) { return std::nullopt; };
  csv.needs = [](std::size_t) { return false; };
  csv.has_text = [&](std::size_t column) { return joints.is_name(column); };
  csv.text = [&](std::size_t column, std::string_view text) { joints.set_name(column, text); };
  csv.note = [](const std::string&) {};
  csv.row = [](std::span<const double>, std::size_t) { return std::nullopt; };
  csv.is_done = [&] { return !joints.names().empty(); };
  read_numbers_csv(path, csv);
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
  /// Whether no column is wanted.
  bool empty() const { return wanted_.empty(); }
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
  csv.is_done = [&] { return columns.empty(); };
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
  if (wanted.empty()) return;
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

}  // namespace touchdown::logs
