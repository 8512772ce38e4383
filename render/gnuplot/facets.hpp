#pragma once

#include <optional>

#include "core/table.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws a figure of a table. Its data file holds the drawn rows of the table, its script selects
/// them by their cells. Groups without rows and measures without values are left out; a figure
/// without values is not drawn. Files and errors as `draw_figure`.
std::optional<Figure> draw_facets(const experiments::FigureSpec& spec, const Table& table,
                                  const FigureFile& file);

}  // namespace touchdown::render
