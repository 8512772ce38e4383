#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::render {

/// A drawn row of a table, with its places among the groups of the figure.
struct FacetRow {
  TableRow cells;
  std::size_t panel = 0, series = 0, row = 0;
  std::size_t mark = 0;  ///< the first with conditions that it passes
  double x = 0.0;        ///< its place in the order of `x`; unused with `rows`
};

/// The rows of a table that a figure draws. Rows that a curve joins follow each other, by `x`. They
/// refer to the table.
std::vector<FacetRow> facet_rows(const experiments::FigureSpec& spec, const Table& table);

/// The rows as the data file of a script: CSV, with `percent_encoded` cells.
std::string data_file(const Table& table, const std::vector<FacetRow>& rows);

/// The text with each character that gnuplot does not read back from a CSV cell as %XX, its byte in
/// hexadecimal digits.
std::string percent_encoded(const std::string& text);

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

/// Rings and crosses are drawn around and over other marks, without intervals and with lines of a
/// width of their own.
bool is_highlight(experiments::MarkShape shape);

/// The cells of an image: what they have room for, and their size (px).
struct ImageCells {
  enum class Content : int { colour, number, interval } content = Content::colour;
  std::size_t columns = 0, rows = 0;
  double width = 0.0, height = 0.0;

  double panel_width() const { return width * static_cast<double>(columns); }
  double panel_height() const { return height * static_cast<double>(rows); }
};
inline constexpr double scale_width = 88.0;  ///< of the colours beside an image (px)
ImageCells image_cells(std::size_t columns, std::size_t rows, bool has_intervals, double room);

/// Commands for images: the colours, their scale and the function `shade`, a value's place on it.
std::string image_style();

/// An element of gnuplot's `plot`, without a title. `file` is a text constant.
std::string plot_command(const experiments::FigureSpec& spec,
                         const experiments::FigureAxis& measure, experiments::MarkShape shape,
                         const std::string& file, const FacetPlot& plot);

/// Likewise for an image, the crosses on its cells, and the numbers in them, which are empty where
/// they have no room. The functions `xplace` and `yplace` are the places on the axes.
std::string image_plot(experiments::MarkShape shape, ImageCells::Content content,
                       const std::string& file, const std::vector<std::string>& selections,
                       const experiments::FigureAxis& measure);

/// What a layout depends on: numbers of drawn groups and measures, and widths of texts (px).
struct FacetShape {
  std::size_t panels = 1, measures = 1, series = 1;
  std::size_t rows = 0;   ///< 0: curves over x
  ImageCells cells = {};  ///< of images
  bool has_titles = false;
  bool is_own_x = false;  ///< each panel has its own values of x
  bool is_wide = false;   ///< of lines alone
  double row_names = 0.0, key = 0.0;
  double room = HUGE_VAL;  ///< in which panels should fit (px)
};

/// The position of one panel (px), and the labels around it.
struct FacetPanel {
  std::size_t panel = 0, measure = 0;
  double left = 0.0, top = 0.0;
  bool has_title = false;
  bool has_x_tics = false, has_x_title = false;
  bool is_leftmost = false;  ///< has the names of rows, or the labels of the vertical axis
};

/// Panels in lines of at most four, images of at most three. With several measures, each has a line
/// of its own, or with `rows` a column of its own.
struct FacetLayout {
  std::vector<FacetPanel> panels;
  double panel_width = 0.0, panel_height = 0.0;
  double width = 0.0, height = 0.0;
  double key_left = 0.0, key_top = 0.0;
};
FacetLayout facet_layout(const FacetShape& shape);

}  // namespace touchdown::render
