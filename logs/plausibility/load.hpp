#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "estimator/force/leg_geometry.hpp"
#include "logs/plausibility/findings.hpp"
#include "logs/plausibility/window.hpp"

namespace touchdown::logs {

/// The torques of hips and knees and those that carry the robot, while it is still: then the ground
/// pushes each wheel along the vertical, with a force between 0 (it hangs) and the robot's weight.
/// Another order, sign, factor or zero with which the torques do so is the likely cause of others.
class LoadRelation {
 public:
  /// `is_known`: `geometry` is that of the log's robot, and not an assumption.
  LoadRelation(const LegGeometry& geometry, bool is_known)
      : geometry_(geometry), is_known_(is_known) {}

  /// Adds a stretch in which the robot is still (`StillStretches`).
  void add_still(const CheckedWindow& stretch);
  /// Adds any window: the torques of a whole log have a least size.
  void add(const CheckedWindow& window);
  /// Whether the legs never carry the robot.
  bool hangs() const { return stretches_ > 0 && largest_factor_ < 0.5; }
  /// `drives`: the wheels drive the robot, so that its legs carry it.
  void report(Findings& findings, bool drives) const;

 private:
  static constexpr std::size_t zeros = 4;  ///< of both hips and knees

  std::string weight_text() const;
  std::string scale_text() const;
  std::string cause(bool drives) const;
  bool explains_weight() const;
  bool report_zero(Findings& findings) const;
  void report_small_torques(Findings& findings) const;
  bool report_pose(Findings& findings) const;
  std::size_t best_cause(bool carries, bool moved) const;

  LegGeometry geometry_;
  bool is_known_;
  int stretches_ = 0;           ///< in which the load can be observed
  std::vector<double> misfit_;  ///< sums by causes, by errors; the first is the log as it is
  std::vector<double> load_;    ///< sums of both legs' (N)
  /// Sums of what the torques carry beside the legs' own weight, and would have to (N), each by
  /// the square of its error.
  double carried_ = 0.0;
  double to_carry_ = 0.0;
  double own_ = 0.0;                      ///< likewise: both legs' load without torques
  double scaled_misfit_ = 0.0;            ///< of the torques by a factor that gives the weight
  double largest_load_ = 0.0;             ///< of both legs in a stretch (N) …
  double largest_factor_ = -1e9;          ///< … and of its torques by those that carry the robot
  int standing_stretches_ = 0;            ///< in which the torques carry the robot
  double axle_offset_ = 0.0;              ///< sum (m)
  double apart_ = 0.0;                    ///< sum: the left axle before the right one (m)
  std::array<double, zeros> shift_ = {};  ///< sums: that brings both axles together (rad)
  std::array<double, zeros> shifted_load_ = {};  ///< sums of sizes: load beyond the weight (N)
  double wrong_load_ = 0.0;                      ///< likewise, as it is
  int windows_ = 0;
  double largest_torque_ = 0.0;  ///< of hips and knees (N·m)
};

}  // namespace touchdown::logs
