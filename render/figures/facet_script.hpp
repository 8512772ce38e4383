#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/figures/figure_spec.hpp"

namespace touchdown::render {

/// The gnuplot expression that holds for rows that pass all conditions; empty without
/// conditions.
std::string condition_of(const std::vector<experiments::CellFilter>& where);
/// The same for the rows of one group.
std::string condition_of(const experiments::FigureGroups& groups, std::size_t group);

/// Defines the function `<name><place + 1>`: its argument in rows that fulfil the condition, NaN in
/// others. Empty without a condition.
std::string selection(const char* name, std::size_t place, const std::string& condition);

/// The title of an axis with its unit in brackets.
std::string label(const experiments::FigureAxis& axis);

/// The colour and line of a series. The truth is dark, "always contact" grey.
std::string series_style(const experiments::FigureSpec& spec, std::size_t series);

/// The plotting style of a series in the legend.
const char* key_shape(const experiments::FigureSpec& spec);

/// The plot of one series in one panel.
struct FacetPlot {
  std::vector<std::string> selections = {};  ///< functions that select its rows
  double aside = 0.0;                        ///< shift along the axis without the measure
  std::string style;
};

/// An element of gnuplot's `plot`, without a title. `file` is a text constant.
std::string plot_command(const experiments::FigureSpec& spec,
                         const experiments::FigureAxis& measure, experiments::MarkShape shape,
                         const std::string& file, const FacetPlot& plot);

}  // namespace touchdown::render
