#include "scenarios/ending.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace touchdown::scenarios {

namespace {

/// The cause of a fall. Both causes may hold at once; the tilt then explains the touch.
std::string cause_of_fall(const models::GroundTruth& truth, double limit) {
  const Eigen::Matrix3d base_to_world = truth.base_orientation.normalized().toRotationMatrix();
  if (base_to_world(2, 2) >= std::cos(limit)) return "a part other than a tyre touched the terrain";
  const double pitch = std::asin(std::clamp(-base_to_world(2, 0), -1.0, 1.0));
  const double roll = std::asin(std::clamp(base_to_world(2, 1), -1.0, 1.0));
  return fmt::format("{} beyond {:g} rad", std::abs(pitch) >= std::abs(roll) ? "pitch" : "roll",
                     limit);
}

std::string cause(const recordings::Recording& recording, const End& end) {
  const models::GroundTruth& truth = recording.truth.back();
  switch (*recording.info.outcome) {
    case recordings::Outcome::fell:
      return cause_of_fall(truth, end.fall_tilt);
    case recordings::Outcome::timed_out:
      return fmt::format("at x = {:.2f} m, before the finish line at {:g} m",
                         truth.base_position.x(), end.x);
    case recordings::Outcome::diverged:
      return "position or velocity not finite, or too large to be physical";
    case recordings::Outcome::left_terrain:
      return "the base is below the floor";
    case recordings::Outcome::finished:
      break;
  }
  return {};
}

}  // namespace

std::string outcome_text(recordings::Outcome outcome) {
  if (outcome == recordings::Outcome::left_terrain) return "left the terrain";
  std::string text(recordings::to_text(outcome));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string ending_text(const recordings::Recording& recording, const End& end) {
  const double duration = static_cast<double>(recording.steps()) * recording.period();
  if (!recording.info.outcome) return fmt::format("stopped after {:.3f} s", duration);
  const std::string ended =
      fmt::format("{} after {:.3f} s", outcome_text(*recording.info.outcome), duration);
  const std::string why = recording.truth.empty() ? "" : cause(recording, end);
  return why.empty() ? ended : ended + ": " + why;
}

}  // namespace touchdown::scenarios
