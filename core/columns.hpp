#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/table.hpp"

namespace touchdown {

/// The columns of a table with structs as rows. Each column has a name and a getter: a data member,
/// or anything callable with a row.
///
///     const auto columns = Columns<Row>()
///                              .text("simulator", &Row::simulator)
///                              .interval("balanced_accuracy", &Row::accuracy)
///                              .runs("runs", &Row::runs);
///     directory.write_table("accuracy.csv", columns, rows);
template <typename Row>
class Columns {
 public:
  /// A key: the text itself.
  template <typename Getter>
  Columns& text(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::key, ColumnType::text},
               [getter](const Row& row) { return std::string(std::invoke(getter, row)); });
  }
  /// A key: a number that was set, not measured.
  template <typename Getter>
  Columns& level(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::key, ColumnType::exact},
               [getter](const Row& row) { return double{std::invoke(getter, row)}; });
  }
  /// A key: a whole number.
  template <typename Getter>
  Columns& number(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::key, ColumnType::count}, [getter](const Row& row) {
      return static_cast<std::int64_t>(std::invoke(getter, row));
    });
  }
  /// A measured number.
  template <typename Getter>
  Columns& metric(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::metric, ColumnType::measured},
               [getter](const Row& row) { return rounded(std::invoke(getter, row)); });
  }
  /// A measured number with its interval: three columns.
  template <typename Getter>
  Columns& interval(const std::string& name, Getter getter) {
    last_ = columns_.size();
    add_interval(name, columns_);
    cells_.push_back([getter](const Row& row, std::vector<Cell>& cells) {
      add_interval(std::invoke(getter, row), cells);
    });
    return *this;
  }
  /// A measured count.
  template <typename Getter>
  Columns& count(std::string name, Getter getter) {
    return number(std::move(name), getter).is(ColumnRole::metric);
  }
  /// A measured yes or no: 1 or 0.
  template <typename Getter>
  Columns& flag(std::string name, Getter getter) {
    return count(std::move(name), getter);
  }
  /// The number of runs behind the metrics of a row. A table has at most one such column.
  template <typename Getter>
  Columns& runs(std::string name, Getter getter) {
    return number(std::move(name), getter).is(ColumnRole::runs);
  }

  /// Sets the role of the last column.
  Columns& is(ColumnRole role) {
    columns_[last_].role = role;
    return *this;
  }
  /// Sets the name of the last column in long tables.
  Columns& as(const std::string& name) {
    columns_[last_].as = name;
    return *this;
  }

  /// The columns of a part of the row, which `getter` returns.
  template <typename Getter, typename Part>
  Columns& part(Getter getter, const Columns<Part>& columns) {
    columns_.insert(columns_.end(), columns.list().begin(), columns.list().end());
    cells_.push_back([getter, columns](const Row& row, std::vector<Cell>& cells) {
      columns.add_cells(std::invoke(getter, row), cells);
    });
    return *this;
  }

  const std::vector<Column>& list() const { return columns_; }

  /// Appends the cells of a row.
  void add_cells(const Row& row, std::vector<Cell>& cells) const {
    for (const auto& add : cells_) add(row, cells);
  }

  template <typename Rows>
  Table table(const Rows& rows) const {
    Table table{columns_, {}};
    for (const Row& row : rows) add_cells(row, table.rows.emplace_back());
    return table;
  }

 private:
  template <typename Getter>
  Columns& add(Column column, Getter cell) {
    last_ = columns_.size();
    columns_.push_back(std::move(column));
    cells_.push_back(
        [cell](const Row& row, std::vector<Cell>& cells) { cells.emplace_back(cell(row)); });
    return *this;
  }

  std::vector<Column> columns_;
  std::size_t last_ = 0;  ///< the first column of the last call
  std::vector<std::function<void(const Row&, std::vector<Cell>&)>> cells_;
};

}  // namespace touchdown
