#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/python/arrays.hpp"
#include "logs/mapping/mapping.hpp"
#include "logs/signals_from.hpp"

namespace touchdown::python {

/// Converts the steps of a robot's own loop by the mapping file that converts its logs, and to the
/// same bits. The file's names of columns, arrays or topics' fields are those of a dict of numbers
/// and arrays. Contact labels and the files of `sources` are not looked at.
class MappedLoop {
 public:
  MappedLoop(std::filesystem::path mapping, double sample_rate);

  void reset();
  /// Errors: `InputError` as for logs, and for names that the dict lacks.
  Signals next(const py::object& step);
  /// The steps of a whole run: each array has one row per step.
  std::vector<Signals> all(const py::object& arrays);

 private:
  /// Numbers of a mapped column.
  struct Column {
    StepArray numbers;
    std::size_t item = 0;
  };
  std::vector<Column> columns_of(const py::object& arrays, bool is_one_step);
  Signals convert(const std::vector<Column>& columns, std::size_t step);

  std::filesystem::path path_;
  std::optional<logs::LogMapping> mapping_;  ///< once the names are known
  logs::StepSignals signals_;
  std::size_t steps_ = 0;
  double start_ = 0.0;  ///< time of the first step (s)
};

}  // namespace touchdown::python
