#include "models/terrain_mesh.hpp"

#include <cmath>
#include <utility>

namespace touchdown::models {
namespace {

/// A point of the side view with its surface normal.
struct OutlinePoint {
  double x, z, nx, nz;
};

/// The surface between two points of the outline.
struct OutlineFace {
  OutlinePoint from, to;
};

constexpr int nosing_faces = 10;

void add_segment(const Profile& profile, std::size_t i, std::vector<OutlineFace>& outline) {
  const Profile::Segment& segment = profile.segments()[i];
  const double nx = segment.nx();
  const double nz = segment.nz();
  const Profile::Edge* edge = profile.edge_after(i);
  const double x1 = edge ? edge->tangent_x : segment.x1;
  const double z1 = edge ? segment.z(x1) : segment.z1;
  outline.push_back({{segment.x0, segment.z0, nx, nz}, {x1, z1, nx, nz}});
  if (!edge) return;
  OutlinePoint last = outline.back().to;
  if (edge->radius > 0.0) {
    const double begin = std::atan2(nz, nx);
    for (int k = 1; k <= nosing_faces; ++k) {
      const double angle = begin * (1.0 - static_cast<double>(k) / nosing_faces);
      const bool end = k == nosing_faces;  // exactly on the face, so that vertices coincide
      const OutlinePoint next{end ? edge->x : edge->centre_x + edge->radius * std::cos(angle),
                              edge->centre_z + (end ? 0.0 : edge->radius * std::sin(angle)),
                              std::cos(angle), std::sin(angle)};
      outline.push_back({last, next});
      last = next;
    }
  }
  outline.push_back({{edge->x, last.z, 1.0, 0.0}, {edge->x, edge->bottom, 1.0, 0.0}});
}

class MeshBuilder {
 public:
  explicit MeshBuilder(double width) : y_(0.5 * width) {}

  /// Adds the surface of `face` across the whole width.
  void add_strip(const OutlineFace& face) {
    const auto& [from, to] = face;
    add_quad({vertex(from, -y_), vertex(to, -y_), vertex(to, y_), vertex(from, y_)});
  }

  /// Adds both side walls of a convex column of the side view, as triangle fans about its middle.
  /// `polygon` runs clockwise seen from −y: its inside is on the right.
  void add_walls(const std::vector<std::array<double, 2>>& polygon) {
    double x = 0.0, z = 0.0;
    for (const auto& point : polygon) {
      x += point[0] / static_cast<double>(polygon.size());
      z += point[1] / static_cast<double>(polygon.size());
    }
    for (const double side : {-1.0, 1.0}) {
      const int first = static_cast<int>(mesh_.vertices.size());
      const int count = static_cast<int>(polygon.size());
      mesh_.vertices.push_back({x, side * y_, z, 0.0, side, 0.0});
      for (const auto& [px, pz] : polygon) {
        mesh_.vertices.push_back({px, side * y_, pz, 0.0, side, 0.0});
      }
      for (int k = 0; k < count; ++k) {
        const int a = first + 1 + k;
        const int b = first + 1 + (k + 1) % count;
        if (side > 0) {
          mesh_.faces.push_back({first, a, b});
        } else {
          mesh_.faces.push_back({first, b, a});
        }
      }
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  static Mesh::Vertex vertex(const OutlinePoint& point, double y) {
    return {point.x, y, point.z, point.nx, 0.0, point.nz};
  }

  void add_quad(const std::array<Mesh::Vertex, 4>& corners) {
    const int first = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), corners.begin(), corners.end());
    mesh_.faces.push_back({first, first + 1, first + 2});
    mesh_.faces.push_back({first, first + 2, first + 3});
  }

  double y_;
  Mesh mesh_;
};

/// Closes the surface `outline` (left to right, from floor to floor) into a solid.
Mesh close(const std::vector<OutlineFace>& outline, double width) {
  MeshBuilder builder(width);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& [from, to] = outline[i];
    builder.add_strip(outline[i]);
    if (from.x == to.x) continue;  // a vertical face: its neighbours' walls reach along it
    builder.add_strip({{to.x, 0.0, 0.0, -1.0}, {from.x, 0.0, 0.0, -1.0}});
    std::vector<std::array<double, 2>> column = {{from.x, 0.0}};
    if (i > 0 && outline[i - 1].from.x == from.x && outline[i - 1].from.z > 0.0 &&
        outline[i - 1].from.z < from.z) {
      column.push_back({from.x, outline[i - 1].from.z});
    }
    if (from.z > 0.0) column.push_back({from.x, from.z});
    if (to.z > 0.0) column.push_back({to.x, to.z});
    if (i + 1 < outline.size() && outline[i + 1].to.x == to.x && outline[i + 1].to.z > 0.0 &&
        outline[i + 1].to.z < to.z) {
      column.push_back({to.x, outline[i + 1].to.z});
    }
    column.push_back({to.x, 0.0});
    builder.add_walls(column);
  }
  return builder.take();
}

}  // namespace

std::vector<Mesh> visual_meshes(const Profile& profile, double width) {
  std::vector<Mesh> meshes;
  std::vector<OutlineFace> outline;
  double z = 0.0;  // where the outline so far ends
  const auto finish = [&] {
    if (!outline.empty()) meshes.push_back(close(outline, width));
    outline.clear();
  };
  for (std::size_t i = 0; i < profile.segments().size(); ++i) {
    const Profile::Segment& segment = profile.segments()[i];
    if (segment.z0 <= 0.0 && segment.z1 <= 0.0) {  // the floor itself
      finish();
      z = 0.0;
      continue;
    }
    if (z == 0.0) finish();
    if (segment.z0 > z) {  // a front
      outline.push_back({{segment.x0, z, -1.0, 0.0}, {segment.x0, segment.z0, -1.0, 0.0}});
    }
    add_segment(profile, i, outline);
    z = outline.back().to.z;
  }
  finish();
  return meshes;
}

}  // namespace touchdown::models
