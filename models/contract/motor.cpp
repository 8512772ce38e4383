#include "models/contract/motor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace touchdown::models {

namespace {

/// The upper end of a range that must be symmetric.
double symmetric(const mjtNum* range, const char* what, const FailAtMotor& fail) {
  constexpr double close = 1e-6;
  if (!(range[1] > 0.0) || std::abs(range[0] + range[1]) > close * range[1]) {
    fail(fmt::format("expected a symmetric {}, found {:g} to {:g}", what, range[0], range[1]));
  }
  return range[1];
}

}  // namespace

double torque_limit(const mjModel& model, int motor, const FailAtMotor& fail) {
  if (model.actuator_dyntype[motor] != mjDYN_NONE) {
    fail("expected a motor, found an activation (dyntype)");
  }
  if (model.actuator_gaintype[motor] != mjGAIN_FIXED ||
      (model.actuator_biastype[motor] != mjBIAS_NONE &&
       model.actuator_biastype[motor] != mjBIAS_AFFINE)) {
    fail("expected a motor");
  }
  const bool is_motor = model.actuator_biastype[motor] == mjBIAS_NONE;
  const bool has_force = model.actuator_forcelimited[motor] != 0;
  const bool has_control = is_motor && model.actuator_ctrllimited[motor] != 0;
  if (!is_motor && !has_force) {
    fail("expected a motor, or a forcerange, its torque limit (N·m)");
  }
  if (!has_force && !has_control) {
    fail("expected a ctrlrange or forcerange, its torque limit (N·m)");
  }
  double limit = std::numeric_limits<double>::infinity();
  if (has_control) {
    limit = std::abs(model.actuator_gainprm[mjNGAIN * motor]) *
            symmetric(&model.actuator_ctrlrange[2 * motor], "ctrlrange", fail);
  }
  if (has_force) {
    limit = std::min(limit, symmetric(&model.actuator_forcerange[2 * motor], "forcerange", fail));
  }
  limit *= std::abs(model.actuator_gear[6 * motor]);
  if (!(limit > 0.0)) fail("expected a torque limit above 0 N·m");
  return limit;
}

bool remove_law(mjModel& model, int motor) {
  if (model.actuator_biastype[motor] == mjBIAS_NONE) return false;
  std::fill_n(&model.actuator_gainprm[mjNGAIN * motor], mjNGAIN, 0.0);
  std::fill_n(&model.actuator_biasprm[mjNBIAS * motor], mjNBIAS, 0.0);
  return true;
}

}  // namespace touchdown::models
