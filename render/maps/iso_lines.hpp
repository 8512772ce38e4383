#pragma once

#include <array>
#include <vector>

namespace touchdown::render {

/// Where a surface given on a grid crosses `level`: pieces of line (from, to) in grid coordinates
/// (column, row). Between grid points the surface is linear along the edges (marching squares; a
/// saddle is resolved by its middle). Cells with a NaN corner are left out.
using IsoPiece = std::array<std::array<double, 2>, 2>;
std::vector<IsoPiece> iso_lines(const std::vector<std::vector<double>>& rows, double level);

/// Pieces that share an end, put together into lines from end to end, so that dashes run on along
/// them. A closed line ends where it begins.
using IsoLine = std::vector<std::array<double, 2>>;
std::vector<IsoLine> joined(const std::vector<IsoPiece>& pieces);

}  // namespace touchdown::render
