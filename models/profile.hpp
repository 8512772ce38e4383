#pragma once

#include <cmath>
#include <vector>

#include "models/terrain.hpp"

namespace touchdown::models {

/// The side view of a terrain, from which its collision geoms and its visual mesh are derived. It
/// consists of level or sloping segments in the x–z plane (m). Vertical faces join segments with
/// ends at different heights. A circle, tangent to the segment and the vertical face, rounds the
/// upper corner of a drop. Errors: the constructor throws `InputError` when the ground would go
/// below the floor, or when a rounded edge does not fit on its segment or its drop.
class Profile {
 public:
  /// Straight ground from (x0, z0) to (x1, z1), x0 < x1.
  struct Segment {
    double x0, z0, x1, z1;
    double slope() const { return (z1 - z0) / (x1 - x0); }
    double length_per_x() const { return std::hypot(1.0, slope()); }  ///< length per metre of x
    double nx() const { return -slope() / length_per_x(); }           ///< of the upward normal
    double nz() const { return 1.0 / length_per_x(); }
    double z(double x) const { return z0 + (x - x0) * slope(); }
  };

  /// A drop at `x` from `top` to `bottom`, rounded by a circle about (centre_x, centre_z). The
  /// circle is tangent to the segment at tangent_x.
  struct Edge {
    double x, top, bottom, radius;
    double centre_x, centre_z, tangent_x;
    std::size_t segment;  ///< index of the segment that ends here
  };

  explicit Profile(const Strip& strip);
  /// The profile of the pieces about y = 0.
  explicit Profile(const Terrain& terrain) : Profile(strips_of(terrain).front()) {}

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Edge>& edges() const { return edges_; }
  /// The edge at the end of segment `i`; null if there is none.
  const Edge* edge_after(std::size_t i) const;
  /// Height of the surface at x, with rounded edges. At a drop it is the lower side; outside the
  /// pieces it is 0.
  double height(double x) const;

 private:
  std::vector<Segment> segments_;
  std::vector<Edge> edges_;
};

}  // namespace touchdown::models
