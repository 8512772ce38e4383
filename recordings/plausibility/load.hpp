#pragma once

#include <array>
#include <cstddef>

#include "estimator/force/leg_geometry.hpp"
#include "recordings/plausibility/findings.hpp"
#include "recordings/plausibility/window.hpp"

namespace touchdown::recordings {

/// Checks the torques of hips and knees while the robot is still. Then the ground pushes each wheel
/// upwards with a force between 0 (it hangs) and the robot's weight, and not forwards. If the
/// torques of a log do not show such forces, but would with another sign, unit or order, that is
/// the likely cause.
class LoadCheck {
 public:
  /// `is_known`: `geometry` is that of the log's robot, and not an assumption.
  LoadCheck(const LegGeometry& geometry, bool is_known)
      : geometry_(geometry), is_known_(is_known) {}

  /// Adds a stretch in which the robot is still (`StillStretches`).
  void add_still(const CheckedWindow& stretch);
  /// Adds any window: the torques of a whole log have a least size.
  void add(const CheckedWindow& window);
  /// `drives`: the wheels drive the robot, so that its legs carry it.
  void report(Findings& findings, bool drives) const;

 private:
  static constexpr std::size_t hypotheses = 9;

  bool report_misfit(Findings& findings) const;
  void report_small_load(Findings& findings) const;
  void report_small_torques(Findings& findings) const;
  void report_pose(Findings& findings) const;

  LegGeometry geometry_;
  bool is_known_;
  int stretches_ = 0;                           ///< in which the load can be observed
  std::array<double, hypotheses> misfit_ = {};  ///< sums (N); the first is the log as it is
  double tolerance_ = 0.0;                      ///< sum (N)
  std::array<double, hypotheses> load_ = {};    ///< sums of both legs' (N)
  double largest_load_ = 0.0;                   ///< of both legs in a stretch (N)
  int standing_stretches_ = 0;                  ///< in which the torques carry the robot
  double axle_offset_ = 0.0;                    ///< sum (m)
  int windows_ = 0;
  double largest_torque_ = 0.0;  ///< of hips and knees (N·m)
};

}  // namespace touchdown::recordings
