#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace touchdown::render {

/// Whole numbers of 16 bits, little-endian, as base64. Numbers beyond the range are clamped.
std::string packed(const std::vector<double>& values, double unit);
/// Whole numbers of 8 bits.
std::string packed(const std::vector<std::uint8_t>& values);

/// A position p is `origin + unit · (i, j, k)`, with whole numbers of 16 bits. `unit` is in metres.
struct PositionCode {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double unit = 1e-5;
};
/// The finest code of these positions.
PositionCode code_of(const std::vector<Eigen::Vector3d>& positions);

/// Triangles of a mesh.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< m
  std::vector<int> indices;               ///< three per triangle
};

/// The mesh with at most `most_triangles`, if need be by moving its vertices to a coarser and
/// coarser grid and leaving out triangles without area.
TriangleMesh reduced(const TriangleMesh& mesh, std::size_t most_triangles);

}  // namespace touchdown::render
