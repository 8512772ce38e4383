#include "apps/python/mapped_loop.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/mapping/row_values.hpp"

namespace touchdown::python {

namespace {

/// The names of the dict as the sources that the mapping expects: joints and IMU may be two of
/// them, which in a loop have one clock.
std::vector<logs::SourceNames> sources_of(const py::object& arrays,
                                          const std::filesystem::path& mapping) {
  logs::SourceNames names{.file = "signals", .are_arrays = true, .names = {}};
  for (const py::handle name : arrays) names.names.push_back(py::cast<std::string>(name));
  names.is_topic = names.is_imu =
      std::ranges::find(names.names, "orientation.x") != names.names.end();
  names.has_joint_names = names.is_topic;
  if (!names.is_topic && logs::read_log_sources(mapping).empty()) return {names};
  std::vector<logs::SourceNames> sources(2, names);
  sources[0].section = "joints";
  sources[1].section = "imu";
  return sources;
}

/// The numbers of one array; those of one step are one row.
StepArray numbers_of(const py::object& arrays, const std::string& name, bool is_one_step) {
  if (!arrays.contains(name)) throw InputError(fmt::format("signals: '{}' is missing", name));
  auto array = StepArray::Array::ensure(arrays[py::str(name)]);
  if (!array || array.ndim() > (is_one_step ? 1 : 2) || (!is_one_step && array.ndim() == 0)) {
    PyErr_Clear();
    throw InputError(fmt::format(
        "signals: '{}': expected {}", name,
        is_one_step ? "a number or a row of numbers" : "an array with one row per step"));
  }
  if (!is_one_step) return StepArray(array);
  return StepArray(StepArray::Array(array.reshape({py::ssize_t{1}, array.size()})));
}

}  // namespace

MappedLoop::MappedLoop(std::filesystem::path mapping, double sample_rate)
    : path_(std::move(mapping)), signals_(sample_rate) {}

void MappedLoop::reset() {
  signals_.reset();
  steps_ = 0;
}

Signals MappedLoop::next(const py::object& step) { return convert(columns_of(step, true), 0); }

std::vector<Signals> MappedLoop::all(const py::object& arrays) {
  const std::vector<Column> columns = columns_of(arrays, false);
  reset();
  std::vector<Signals> steps(columns.front().numbers.steps());
  for (std::size_t k = 0; k < steps.size(); ++k) steps[k] = convert(columns, k);
  return steps;
}

std::vector<MappedLoop::Column> MappedLoop::columns_of(const py::object& arrays, bool is_one_step) {
  if (!mapping_) {
    mapping_ = logs::read_log_mapping(path_, sources_of(arrays, path_), false);
  }
  std::vector<Column> columns;
  for (const logs::SourceColumn& column : mapping_->columns) {
    const std::size_t item = column.index.value_or(0);
    columns.push_back({numbers_of(arrays, column.name, is_one_step), item});
    const StepArray& numbers = columns.back().numbers;
    if (numbers.steps() != columns.front().numbers.steps() || item >= numbers.items()) {
      throw InputError(fmt::format(
          "signals: '{}': expected {} rows with at least {} numbers, found {} with {}", column.name,
          columns.front().numbers.steps(), item + 1, numbers.steps(), numbers.items()));
    }
  }
  return columns;
}

Signals MappedLoop::convert(const std::vector<Column>& columns, std::size_t step) {
  std::vector<double> row;
  for (const Column& column : columns) row.push_back(column.numbers(step, column.item));
  logs::LogRow mapped =
      logs::to_row(logs::log_values(*mapping_, steps_, row), logs::log_presence(*mapping_));
  double& time = mapped.observation.time;
  if (steps_++ == 0) start_ = time;
  if (start_ != 0.0) time -= start_;
  return signals_.next(mapped.observation, mapped.action);
}

}  // namespace touchdown::python
