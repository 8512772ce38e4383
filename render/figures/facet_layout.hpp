#pragma once

#include <cstddef>
#include <vector>

namespace touchdown::render {

/// What a layout depends on: numbers of drawn groups and measures, and widths of texts (px).
struct FacetShape {
  std::size_t panels = 1, measures = 1, series = 1;
  std::size_t rows = 0;  ///< 0: curves over x
  bool has_titles = false;
  bool is_own_x = false;  ///< each panel has its own values of x
  double row_names = 0.0, key = 0.0;
};

/// The position of one panel (px), and the labels around it.
struct FacetPanel {
  std::size_t panel = 0, measure = 0;
  double left = 0.0, top = 0.0;
  bool has_title = false;
  bool has_x_tics = false, has_x_title = false;
  bool is_leftmost = false;  ///< has the names of rows, or the labels of the vertical axis
};

/// Panels in lines of at most four. With several measures, each has a line of its own, or with
/// `rows` a column of its own.
struct FacetLayout {
  std::vector<FacetPanel> panels;
  double panel_width = 0.0, panel_height = 0.0;
  double width = 0.0, height = 0.0;
  double key_left = 0.0, key_top = 0.0;
};

FacetLayout facet_layout(const FacetShape& shape);

}  // namespace touchdown::render
