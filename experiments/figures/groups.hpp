#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// Whether a row of the table passes all conditions.
bool passes(const Table& table, const std::vector<std::string>& row,
            const std::vector<CellFilter>& where);

/// The first group with the row's values: its place; 0 without columns, empty for a row of no
/// group.
std::optional<std::size_t> group_of(const FigureGroups& groups, const Table& table,
                                    const std::vector<std::string>& row);

/// The distinct values of a column among the rows that pass `where`, in the order of the rows, each
/// with its title.
FigureGroups groups_in(const Table& table, const std::string& column,
                       const std::function<std::string(const std::string& value)>& title,
                       const std::vector<CellFilter>& where = {});

/// The same for the combinations of values of several columns.
FigureGroups combinations_in(
    const Table& table, const std::vector<std::string>& columns,
    const std::function<std::string(const std::vector<std::string>& values)>& title,
    const std::vector<CellFilter>& where = {});

/// The axis of a measured column, with the columns of its interval beside it.
FigureAxis axis_with_interval(const std::string& column, const std::string& title);

/// The value of a cell as an axis draws it; NaN for a cell without a number.
double drawn_value(const FigureAxis& axis, const std::string& cell);

/// The drawn values of the first measure as a text, panel by panel and series by series, for a
/// figure's alternative text. It begins with a space.
std::string values_text(const FigureSpec& spec, const Table& table);

}  // namespace touchdown::experiments
