#include "models/profile.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::models {
namespace {

/// Heights that differ by less count as equal (m): sums of rises do not cancel exactly.
constexpr double level = 1e-9;

/// Nested repetitions grow fast, and the engines could not handle more.
constexpr std::size_t most_segments = 10'000;

/// Lays terrain pieces end to end. Heights are relative to the beginning.
struct Pen {
  double x, z;
  std::vector<Profile::Segment> segments;
  std::vector<double> nosing_radii;  ///< of the edge after each segment

  void go(double length, double rise) {
    if (segments.size() == most_segments) {
      throw InputError(fmt::format("more than {} segments of ground", most_segments));
    }
    segments.push_back({x, z, x + length, z + rise});
    nosing_radii.push_back(0.0);
    x += length;
    z += rise;
  }
  void drop(double height, double nosing_radius) {
    if (segments.empty()) throw InputError("nothing to drop from: the first piece must be ground");
    nosing_radii.back() = nosing_radius;
    z -= height;
  }

  void operator()(const Flat& flat) { go(flat.length, 0.0); }
  void operator()(const StairFlight& stairs) {
    for (int i = 0; i < stairs.count; ++i) {
      drop(stairs.rise, stairs.nosing_radius);
      go(stairs.run, 0.0);
    }
  }
  void operator()(const Ramp& ramp) {
    go(std::abs(ramp.rise) / std::tan(ramp.incline * std::numbers::pi / 180.0), ramp.rise);
  }
  void operator()(const Platform& platform) {
    z += platform.height;
    go(platform.length, 0.0);
    drop(platform.height, platform.nosing_radius);
  }
  void operator()(const Step& step) { drop(step.drop, step.nosing_radius); }
  void operator()(const Repetition& repetition) {
    for (int i = 0; i < repetition.count; ++i) {
      for (const TerrainPiece& piece : repetition.pieces) std::visit(*this, piece);
    }
  }
};

Profile::Edge rounded_edge(const Profile::Segment& segment, double bottom, double radius) {
  const double slope = segment.slope();
  const double length_per_x = segment.length_per_x();
  return {.x = segment.x1,
          .top = segment.z1,
          .bottom = bottom,
          .radius = radius,
          .centre_x = segment.x1 - radius,
          .centre_z = segment.z1 - radius * slope - radius * length_per_x,
          .tangent_x = segment.x1 - radius - radius * slope / length_per_x,
          .segment = 0};
}

}  // namespace

std::vector<Strip> strips_of(const Terrain& terrain) {
  std::vector<Strip> strips = {
      {{Repetition{terrain.repeat, terrain.pieces}}, terrain.start_x, 0.0, terrain.width}};
  strips.insert(strips.end(), terrain.beside.begin(), terrain.beside.end());
  return strips;
}

Profile::Profile(const Strip& strip) {
  Pen pen{strip.start_x, 0.0, {}, {}};
  for (const TerrainPiece& piece : strip.pieces) std::visit(pen, piece);
  segments_ = std::move(pen.segments);
  for (Segment& segment : segments_) {
    for (double* z : {&segment.z0, &segment.z1}) {
      *z -= pen.z;
      if (std::abs(*z) < level) *z = 0.0;
      if (*z < 0.0) {
        throw InputError(fmt::format("the ground would be {:.3g} m below the floor at x = {:.3g} m",
                                     -*z, segment.x0));
      }
    }
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const double bottom = i + 1 < segments_.size() ? segments_[i + 1].z0 : 0.0;
    if (segments_[i].z1 < bottom + level) continue;
    Edge edge = rounded_edge(segments_[i], bottom, pen.nosing_radii[i]);
    edge.segment = i;
    if (edge.tangent_x <= segments_[i].x0 || edge.centre_z < bottom) {
      throw InputError(
          fmt::format("the edge at x = {:.3g} m has no room for a nosing of {:.3g} m: expected a "
                      "smaller nosing_radius, a higher edge or more ground before it",
                      edge.x, edge.radius));
    }
    edges_.push_back(edge);
  }
}

const Profile::Edge* Profile::edge_after(std::size_t i) const {
  for (const Edge& edge : edges_) {
    if (edge.segment == i) return &edge;
  }
  return nullptr;
}

double Profile::height(double x) const {
  for (const Segment& segment : segments_) {
    if (x < segment.x0 || x >= segment.x1) continue;
    for (const Edge& edge : edges_) {
      if (x < edge.x && x > edge.tangent_x) {
        return edge.centre_z +
               std::sqrt(edge.radius * edge.radius - (x - edge.centre_x) * (x - edge.centre_x));
      }
    }
    return segment.z(x);
  }
  return 0.0;
}

}  // namespace touchdown::models
