#pragma once

#include <array>
#include <vector>

namespace touchdown::render {

/// A line segment (from, to) in grid coordinates (column, row).
using IsoSegment = std::array<std::array<double, 2>, 2>;

/// The segments along which a surface given on a grid crosses `level` (marching squares). Between
/// grid points the surface is linear along the edges; a saddle is resolved by its middle. Cells
/// with a NaN corner are left out.
std::vector<IsoSegment> iso_lines(const std::vector<std::vector<double>>& rows, double level);

/// The points of a line in grid coordinates; a closed line ends where it begins.
using IsoLine = std::vector<std::array<double, 2>>;

/// Joins segments that share an end into lines, so that dashes continue along them.
std::vector<IsoLine> joined(const std::vector<IsoSegment>& segments);

}  // namespace touchdown::render
