#include <algorithm>
#include <array>
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
#include "core/files.hpp"
#include "estimator/npz/npz.hpp"
#include "logs/log/byte_source.hpp"
#include "logs/log/numbers_csv.hpp"
#include "logs/mapping/row_source.hpp"

namespace touchdown::logs {

namespace {

constexpr std::array<std::string_view, 3> joint_fields = {"position", "velocity", "effort"};

std::optional<std::size_t> position_in(const std::vector<std::string>& columns,
                                       std::string_view name) {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

/// Whether this is how an index is written behind a list's name: [0], .0, /0, _0 or 0.
bool is_index(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) {
    text = text.substr(1, text.size() - 2);
  } else if (text.starts_with('.') || text.starts_with('/') || text.starts_with('_')) {
    text.remove_prefix(1);
  }
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// The columns of a sensor_msgs/JointState in a CSV file, as programs write its lists: name[0],
/// position[0], velocity[0], effort[0], name[1], … A joint is found by the name in its row, as in a
/// bag: as a column NAME/position, NAME/velocity or NAME/effort.
class JointColumns {
 public:
  /// Finds the lists among these columns, if there is one of names. Before a list's name there may
  /// be those of its message (field.name0).
  explicit JointColumns(const std::vector<std::string>& columns) {
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
      bool has_numbers = false;
      for (std::size_t f = 0; f < joint_fields.size(); ++f) {
        std::string number = column;
        number.replace(at, list.size(), joint_fields.at(f));
        joint.numbers.at(f) = position_in(columns, number);
        has_numbers = has_numbers || joint.numbers.at(f);
      }
      if (has_numbers) joints_.push_back(std::move(joint));
    }
  }

  bool empty() const { return joints_.empty(); }
  bool is_number(std::size_t column) const {
    return std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
      return std::find(joint.numbers.begin(), joint.numbers.end(), column) != joint.numbers.end();
    });
  }

  /// Takes the names of joints from the present row.
  void take_names(const NumbersCsv& csv) {
    for (Joint& joint : joints_) joint.name = csv.text(joint.name_column);
  }

  /// The columns that the joints of the present row have, by name.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Joint& joint : joints_) {
      for (std::size_t f = 0; f < joint_fields.size(); ++f) {
        if (joint.name.empty() || !joint.numbers.at(f)) continue;
        names.push_back(fmt::format("{}/{}", joint.name, joint_fields.at(f)));
      }
    }
    return names;
  }

  /// Where the number of a joint's column is in the present row; nothing if the row lacks it.
  std::optional<std::size_t> column_of(std::string_view joint_column) const {
    for (const Joint& joint : joints_) {
      const std::size_t size = joint.name.size();
      if (size == 0 || joint_column.size() <= size || !joint_column.starts_with(joint.name) ||
          joint_column[size] != '/') {
        continue;
      }
      const auto* const field = std::ranges::find(joint_fields, joint_column.substr(size + 1));
      if (field != joint_fields.end())
        return joint.numbers.at(static_cast<std::size_t>(field - joint_fields.begin()));
    }
    return std::nullopt;
  }

 private:
  struct Joint {
    std::size_t name_column = 0;
    std::array<std::optional<std::size_t>, 3> numbers;  ///< position, velocity, effort
    std::string name;                                   ///< in the present row
  };
  std::vector<Joint> joints_;
};

/// The columns that the joints' names in the first row with names give.
std::vector<std::string> first_joint_names(const std::filesystem::path& path, JointColumns joints) {
  NumbersCsv csv(path, {.may_be_cut_off = true});
  csv.select(std::vector<bool>(csv.names().size()));
  while (joints.names().empty() && csv.next()) joints.take_names(csv);
  return joints.names();
}

/// A file: one source.
class FileSource : public RowSource {
 public:
  FileSource(const std::filesystem::path& path, LogNotes& notes) : RowSource(notes) {
    names_.file = path.string();
  }
  std::span<const SourceNames> names() const override { return {&names_, 1}; }

 protected:
  SourceNames names_;
};

class CsvFile final : public FileSource {
 public:
  CsvFile(const std::filesystem::path& path, LogNotes& notes)
      : FileSource(path, notes),
        csv_(path,
             {.empty_cell = std::numeric_limits<double>::quiet_NaN(), .may_be_cut_off = true}),
        joints_(csv_.names()) {
    names_.names = csv_.names();
    if (names_.names == std::vector<std::string>{""}) csv_.complain(0, "expected a line of names");
    if (joints_.empty()) return;
    for (std::string& name : first_joint_names(path, joints_)) {
      if (position_in(csv_.names(), name)) continue;
      names_.names.push_back(std::move(name));
      names_.has_joint_names = true;
    }
  }

  void select(const LogMapping& mapping) override {
    wanted_ = mapping.columns;
    std::vector<bool> needed(csv_.names().size());
    for (const SourceColumn& column : wanted_) {
      positions_.push_back(position_in(csv_.names(), column.name));
      needs_joints_ = needs_joints_ || !positions_.back();
    }
    for (std::size_t i = 0; i < needed.size(); ++i) {
      needed[i] = (needs_joints_ && joints_.is_number(i)) ||
                  std::find(positions_.begin(), positions_.end(), i) != positions_.end();
    }
    csv_.select(std::move(needed));
  }

  bool next(std::vector<double>& row) override {
    if (wanted_.empty()) return false;
    if (!csv_.next()) {
      if (!csv_.note().empty()) notes().warnings.push_back(csv_.note());
      return false;
    }
    if (needs_joints_) joints_.take_names(csv_);
    row.resize(wanted_.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto position = positions_[i] ? positions_[i] : joints_.column_of(wanted_[i].name);
      row[i] = !position            ? std::numeric_limits<double>::quiet_NaN()
               : wanted_[i].is_rest ? csv_.rest(*position)
                                    : csv_.values()[*position];
    }
    return true;
  }

  std::string place() const override { return fmt::format("{}:{}", names_.file, csv_.line()); }

 private:
  NumbersCsv csv_;
  JointColumns joints_;
  bool needs_joints_ = false;
  std::vector<SourceColumn> wanted_;
  /// Of the wanted columns in a line; without one, the joint's column is found by name in each row.
  std::vector<std::optional<std::size_t>> positions_;
};

/// A column of an array: its first number, and the distance between numbers.
struct ArrayColumn {
  const double* first = nullptr;
  std::size_t stride = 1;
};

std::size_t width_of(const ModelArray& array) {
  return array.shape.size() == 2 ? array.shape[1] : 1;
}

ArrayColumn column_of(const ModelArrays& arrays, const SourceColumn& column,
                      const std::filesystem::path& path) {
  const ModelArray& array = arrays.at(column.name);
  const std::size_t width = width_of(array);
  if (!column.index && width != 1) {
    if (array.shape[0] == 1) {
      throw InputError(fmt::format("{}: {}: is 1 × {}: expected one axis: array.ravel() makes it",
                                   path.string(), column.name, width));
    }
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

class ArrayFile final : public FileSource {
 public:
  ArrayFile(const std::filesystem::path& path, LogNotes& notes)
      : FileSource(path, notes), path_(path) {
    names_.are_arrays = true;
    names_.names = npz_names(path);
    names_.shape = [path](const std::string& name) -> std::array<std::size_t, 2> {
      const ModelArrays one = read_npz(path, [&](std::string_view other) { return other == name; });
      const auto found = one.find(name);
      if (found == one.end()) return {0, 1};
      return {found->second.shape[0], width_of(found->second)};
    };
  }

  void select(const LogMapping& mapping) override {
    const std::vector<SourceColumn>& wanted = mapping.columns;
    if (wanted.empty()) return;
    arrays_ = read_npz(path_, [&](std::string_view name) {
      return std::ranges::find(wanted, name, &SourceColumn::name) != wanted.end();
    });
    const std::string& first = wanted.front().name;
    rows_ = arrays_.at(first).shape.front();
    for (const SourceColumn& column : wanted) {
      columns_.push_back(column_of(arrays_, column, path_));
      if (column.is_rest) {
        rest_ = read_npz(
            path_, [&](std::string_view name) { return name == column.name; }, NpyPart::rest);
        columns_.back() = column_of(rest_, column, path_);
      }
      require_rows(column.name, first);
    }
  }

  bool next(std::vector<double>& row) override {
    if (next_ == rows_) return false;
    row.clear();
    for (const ArrayColumn& column : columns_) row.push_back(column.first[next_ * column.stride]);
    ++next_;
    return true;
  }

  std::string place() const override { return fmt::format("{}: row {}", names_.file, next_ - 1); }

 private:
  /// Errors: `InputError` for an array of another number of rows than the first one.
  void require_rows(const std::string& name, const std::string& first) const {
    const ModelArray& array = arrays_.at(name);
    if (array.shape[0] == rows_) return;
    const ModelArray& other = arrays_.at(first);
    const std::string lengths = fmt::format("{}: {} has {} rows, and {} has {}", names_.file, name,
                                            array.shape[0], first, rows_);
    const bool is_transposed = width_of(array) == rows_;
    if (!is_transposed && width_of(other) != array.shape[0]) throw InputError(lengths);
    throw InputError(fmt::format(
        "{}: {} is {}: expected a row for each time: array.T transposes it", lengths,
        is_transposed ? name : first, fmt::join((is_transposed ? array : other).shape, " × ")));
  }

  std::filesystem::path path_;
  ModelArrays arrays_;
  ModelArrays rest_;  ///< of the clock
  std::vector<ArrayColumn> columns_;
  std::size_t rows_ = 0;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<RowSource> open_file(const std::filesystem::path& file, LogNotes& notes) {
  const std::string extension = extension_of(file);
  if (extension == ".csv" || extension == ".tsv") return std::make_unique<CsvFile>(file, notes);
  if (extension == ".npz") return std::make_unique<ArrayFile>(file, notes);
  require_no_gzip(file);
  throw InputError(
      fmt::format("{}: expected a log as FILE.csv or FILE.npz, or a ROS 2 bag", file.string()));
}

}  // namespace touchdown::logs
