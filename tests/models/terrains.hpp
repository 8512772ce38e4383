#pragma once

#include "models/profile.hpp"

namespace touchdown::models {

inline double height_at(const Terrain& terrain, double x) { return Profile(terrain).height(x); }

inline std::vector<double> edges(const Terrain& terrain) {
  std::vector<double> result;
  const Profile profile(terrain);
  for (const Profile::Edge& edge : profile.edges()) result.push_back(edge.x);
  return result;
}

inline Terrain stairs() { return {.pieces = {Flat{3.0}, StairFlight{}}}; }

/// Up a ramp, down a small drop onto a platform, down a large drop to the floor; twice.
inline Terrain course() {
  return {.pieces = {Flat{1.0}, Ramp{8.0, 0.15}, Step{0.03, 0.025}, Flat{1.5}, Step{0.12, 0.025},
                     Flat{1.5}},
          .start_x = 1.0,
          .repeat = 2};
}

}  // namespace touchdown::models
