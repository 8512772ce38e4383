#include "render/replay/encoding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "render/report/html.hpp"

namespace touchdown::render {

namespace {

constexpr double largest = std::numeric_limits<std::int16_t>::max();

/// The mesh with its vertices at the middles of a grid's cells.
TriangleMesh on_grid(const TriangleMesh& mesh, const Eigen::Vector3d& corner, double cell) {
  TriangleMesh result;
  std::map<std::array<long, 3>, int> index_of;
  std::vector<int> moved;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3d at = ((vertex - corner) / cell).array().floor();
    const std::array<long, 3> key = {std::lround(at.x()), std::lround(at.y()), std::lround(at.z())};
    const auto [found, is_new] =
        index_of.try_emplace(key, static_cast<int>(result.vertices.size()));
    if (is_new) {
      result.vertices.emplace_back(corner + cell * (at + Eigen::Vector3d::Constant(0.5)));
    }
    moved.push_back(found->second);
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<int, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = moved[static_cast<std::size_t>(mesh.indices[i + k])];
    }
    const auto [a, b, c] = triangle;
    if (a == b || b == c || c == a) continue;
    result.indices.insert(result.indices.end(), triangle.begin(), triangle.end());
  }
  return result;
}

}  // namespace

std::string packed(const std::vector<double>& values, double unit) {
  std::string bytes;
  bytes.reserve(2 * values.size());
  for (const double value : values) {
    const double steps = std::isfinite(value) ? value / unit : 0.0;
    const auto code = static_cast<std::uint16_t>(
        static_cast<std::int16_t>(std::lround(std::clamp(steps, -largest, largest))));
    bytes += static_cast<char>(code & 0xffU);
    bytes += static_cast<char>(code >> 8U);
  }
  return base64(bytes);
}

std::string packed(const std::vector<std::uint8_t>& values) {
  return base64(std::string_view(reinterpret_cast<const char*>(values.data()), values.size()));
}

PositionCode code_of(const std::vector<Eigen::Vector3d>& positions) {
  if (positions.empty()) return {};
  Eigen::Vector3d low = positions.front();
  Eigen::Vector3d high = positions.front();
  for (const Eigen::Vector3d& position : positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  PositionCode code{.origin = 0.5 * (low + high)};
  code.unit = std::max(code.unit, 0.5 * (high - low).maxCoeff() / largest);
  return code;
}

TriangleMesh reduced(const TriangleMesh& mesh, std::size_t most_triangles) {
  TriangleMesh result = mesh;
  if (mesh.vertices.empty()) return result;
  Eigen::Vector3d low = mesh.vertices.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  double cells = 256.0;
  while (result.indices.size() > 3 * most_triangles && cells > 1.0) {
    result = on_grid(mesh, low, (high - low).maxCoeff() / cells);
    cells /= 1.25;
  }
  return result;
}

}  // namespace touchdown::render
