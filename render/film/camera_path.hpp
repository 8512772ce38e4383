#pragma once

#include <vector>

#include <Eigen/Core>

namespace touchdown::render {

/// `values`, sampled every `period` seconds, through a first-order low-pass of `time_constant`
/// seconds run forward and then backward: smooth, and with no lag.
std::vector<Eigen::Vector3d> smoothed(std::vector<Eigen::Vector3d> values, double period,
                                      double time_constant);

}  // namespace touchdown::render
