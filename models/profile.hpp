#pragma once

#include <cmath>
#include <vector>

#include "models/terrain.hpp"

namespace touchdown::models {

/// The side view of a terrain, from which its collision geoms and its visual mesh are
/// derived: level or sloping segments in the x–z plane (m), joined by vertical faces where
/// their ends differ in height. A drop's upper corner is rounded by a circle that touches the
/// segment and the vertical face. Errors: the constructor throws `InputError` when the ground would
/// go below the floor, or when a rounded edge does not fit on its segment or its drop.
class Profile {
 public:
  /// One straight stretch of ground, from (x0, z0) to (x1, z1), x0 < x1.
  struct Segment {
    double x0, z0, x1, z1;
    double slope() const { return (z1 - z0) / (x1 - x0); }
    double stretch() const { return std::hypot(1.0, slope()); }  ///< its length per metre of x
    double nx() const { return -slope() / stretch(); }           ///< of its upward normal
    double nz() const { return 1.0 / stretch(); }
    double z(double x) const { return z0 + (x - x0) * slope(); }
  };

  /// A drop at `x` from `top` to `bottom`, rounded by the circle about (centre_x, centre_z), which
  /// leaves the segment at tangent_x.
  struct Edge {
    double x, top, bottom, radius;
    double centre_x, centre_z, tangent_x;
    std::size_t segment;  ///< the one that ends here
  };

  explicit Profile(const Strip& strip);
  /// Of the pieces about y = 0.
  explicit Profile(const Terrain& terrain) : Profile(strips_of(terrain).front()) {}

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Edge>& edges() const { return edges_; }
  /// The edge that segment `i` ends in; null if it ends in none.
  const Edge* edge_after(std::size_t i) const;
  /// Height of the surface at x, with its rounded edges; at a drop itself the lower side, outside
  /// the pieces 0.
  double height(double x) const;

 private:
  std::vector<Segment> segments_;
  std::vector<Edge> edges_;
};

}  // namespace touchdown::models
