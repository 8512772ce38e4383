#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/table.hpp"

namespace touchdown {

/// Functions on lists of rows. A key is a data member, or anything callable with a row that returns
/// a value with `==`. Results are in the order of first appearance.

template <typename Rows>
using RowOf = typename Rows::value_type;
template <typename Rows, typename Key>
using KeyOf = std::decay_t<std::invoke_result_t<Key, const RowOf<Rows>&>>;

/// The different keys.
template <typename Rows, typename Key>
std::vector<KeyOf<Rows, Key>> unique(const Rows& rows, const Key& key) {
  std::vector<KeyOf<Rows, Key>> found;
  for (const auto& row : rows) {
    auto value = std::invoke(key, row);
    if (std::find(found.begin(), found.end(), value) == found.end()) {
      found.push_back(std::move(value));
    }
  }
  return found;
}

/// The rows for which a predicate holds.
template <typename Rows, typename Predicate>
std::vector<RowOf<Rows>> where(const Rows& rows, const Predicate& predicate) {
  std::vector<RowOf<Rows>> found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [&](const auto& row) { return std::invoke(predicate, row); });
  return found;
}

/// Rows with one key.
template <typename Key, typename Row>
struct RowsWithKey {
  Key key;
  std::vector<Row> rows;
};

/// All rows, divided into groups with equal keys.
template <typename Rows, typename Key>
auto group_by(const Rows& rows, const Key& key) {
  std::vector<RowsWithKey<KeyOf<Rows, Key>, RowOf<Rows>>> groups;
  for (const auto& row : rows) {
    auto value = std::invoke(key, row);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const auto& one) { return one.key == value; });
    if (group == groups.end()) group = groups.insert(groups.end(), {std::move(value), {}});
    group->rows.push_back(row);
  }
  return groups;
}

/// A table for people: a line per key `down`, a column per key `across`, each cell from the row
/// with both keys, a dash where there is none. Both keys and the cell are texts; the corner is
/// empty.
template <typename Rows, typename Down, typename Across, typename Cell>
TextTable pivot(const Rows& rows, const Down& down, const Across& across, const Cell& cell) {
  const std::vector<std::string> columns = unique(rows, across);
  TextTable table{{""}, {}};
  table.header.insert(table.header.end(), columns.begin(), columns.end());
  for (const auto& line : group_by(rows, down)) {
    std::vector<std::string>& cells = table.rows.emplace_back(table.header.size(), "–");
    cells.front() = line.key;
    for (const auto& row : line.rows) {
      const auto column = std::find(columns.begin(), columns.end(), std::invoke(across, row));
      cells[1 + static_cast<std::size_t>(column - columns.begin())] = std::invoke(cell, row);
    }
  }
  return table;
}

}  // namespace touchdown
