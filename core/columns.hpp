#pragma once

#include <functional>
#include <string>
#include <tuple>
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
  struct Column {
    ColumnInfo info;
    std::function<std::vector<std::string>(const Row&)> cells;  ///< one, or three with bounds
  };

  /// A key: the text itself.
  template <typename Getter>
  Columns& text(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::key},
               [getter](const Row& row) { return std::string(std::invoke(getter, row)); });
  }
  /// A key: a number that was set, not measured, as `exact` formats it.
  template <typename Getter>
  Columns& level(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::key},
               [getter](const Row& row) { return exact(std::invoke(getter, row)); });
  }
  /// A key: a whole number.
  template <typename Getter>
  Columns& number(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::key},
               [getter](const Row& row) { return std::to_string(std::invoke(getter, row)); });
  }
  /// A measured number, as `metric` formats it.
  template <typename Getter>
  Columns& metric(std::string name, Getter getter) {
    return add({std::move(name), ColumnRole::metric},
               [getter](const Row& row) { return touchdown::metric(std::invoke(getter, row)); });
  }
  /// A measured number with its interval.
  template <typename Getter>
  Columns& interval(std::string name, Getter getter) {
    ColumnInfo info{std::move(name), ColumnRole::metric};
    info.has_bounds = true;
    columns_.push_back({std::move(info), [getter](const Row& row) {
                          const Interval interval = std::invoke(getter, row);
                          return std::vector{touchdown::metric(interval.estimate),
                                             touchdown::metric(interval.low),
                                             touchdown::metric(interval.high)};
                        }});
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
    return add({std::move(name), ColumnRole::metric}, [getter](const Row& row) {
      return std::string(std::invoke(getter, row) ? "1" : "0");
    });
  }
  /// The number of runs behind the metrics of a row. A table has at most one such column.
  template <typename Getter>
  Columns& runs(std::string name, Getter getter) {
    return number(std::move(name), getter).is(ColumnRole::runs);
  }

  /// Sets the role of the last column.
  Columns& is(ColumnRole role) {
    columns_.back().info.role = role;
    return *this;
  }
  /// Sets the name of the last column in long tables.
  Columns& as(const std::string& name) {
    columns_.back().info.as = name;
    return *this;
  }

  /// The columns of a part of the row, which `getter` returns.
  template <typename Getter, typename Part>
  Columns& part(Getter getter, const Columns<Part>& columns) {
    for (const auto& column : columns.list()) {
      columns_.push_back({column.info, [getter, cells = column.cells](const Row& row) {
                            return cells(std::invoke(getter, row));
                          }});
    }
    return *this;
  }

  /// More columns of the same row.
  Columns& and_then(const Columns& more) {
    columns_.insert(columns_.end(), more.columns_.begin(), more.columns_.end());
    return *this;
  }

  const std::vector<Column>& list() const { return columns_; }

  std::vector<ColumnInfo> infos() const {
    std::vector<ColumnInfo> infos;
    for (const Column& column : columns_) infos.push_back(column.info);
    return infos;
  }

  std::vector<std::string> header() const {
    std::vector<std::string> names;
    for (const Column& column : columns_) {
      for (std::string& name : column.info.cell_names()) names.push_back(std::move(name));
    }
    return names;
  }

  std::vector<std::string> cells(const Row& row) const {
    std::vector<std::string> all;
    for (const Column& column : columns_) {
      for (std::string& cell : column.cells(row)) all.push_back(std::move(cell));
    }
    return all;
  }

  /// One line per row; without the meanings of the columns, `infos`.
  template <typename Rows>
  Table table(const Rows& rows) const {
    Table table{header(), {}};
    for (const Row& row : rows) table.rows.push_back(cells(row));
    return table;
  }

 private:
  template <typename Cell>
  Columns& add(ColumnInfo info, Cell cell) {
    columns_.push_back(
        {std::move(info), [cell](const Row& row) { return std::vector{cell(row)}; }});
    return *this;
  }

  std::vector<Column> columns_;
};

}  // namespace touchdown
