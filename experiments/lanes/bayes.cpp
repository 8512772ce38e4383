#include "experiments/lanes/bayes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchdown::experiments {
namespace {

std::vector<LaneNoise> different_torque_levels(std::span<const LaneNoise> levels) {
  std::vector<LaneNoise> different;
  for (LaneNoise level : levels) {
    level.acceleration = 0.0;
    if (std::find(different.begin(), different.end(), level) == different.end()) {
      different.push_back(level);
    }
  }
  return different;
}

std::vector<double> different_acceleration_levels(std::span<const LaneNoise> levels) {
  std::vector<double> different;
  for (const LaneNoise& level : levels) {
    if (std::find(different.begin(), different.end(), level.acceleration) == different.end()) {
      different.push_back(level.acceleration);
    }
  }
  return different;
}

template <typename T>
std::uint32_t index_of(const std::vector<T>& values, const T& value) {
  return static_cast<std::uint32_t>(std::find(values.begin(), values.end(), value) -
                                    values.begin());
}

bool is_finite(const Signals& clean, const NoiseStep& draws) noexcept {
  double sum = clean.vertical_acceleration * 0.0 + draws.acceleration * 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    sum += clean.leg[side].knee.torque * 0.0 + clean.leg[side].wheel.torque * 0.0;
    sum += draws.torque[side].knee * 0.0 + draws.torque[side].wheel * 0.0;
  }
  return sum == 0.0;  // 0 × anything finite is 0, 0 × anything else is NaN
}

}  // namespace

BayesFilterLanes::BayesFilterLanes(MeasurementModel model, const BayesFilterConfig& config,
                                   std::span<const LaneNoise> levels)
    : measurement_(std::move(model), config, different_torque_levels(levels)),
      transition_(config.transition, config.sample_rate, different_acceleration_levels(levels)) {
  const std::vector<LaneNoise> torques = different_torque_levels(levels);
  const std::vector<double> accelerations = different_acceleration_levels(levels);
  for (LaneNoise level : levels) {
    acceleration_index_.push_back(index_of(accelerations, level.acceleration));
    level.acceleration = 0.0;
    torque_index_.push_back(index_of(torques, level));
  }
  for (auto* belief : {&contact_, &no_contact_}) {
    (*belief)[0].resize(levels.size());
    (*belief)[1].resize(levels.size());
  }
  reset();
}

void BayesFilterLanes::reset() noexcept {
  measurement_.reset();
  transition_.reset();
  for (auto* belief : {&contact_, &no_contact_}) {
    for (std::vector<double>& wheel : *belief) {
      std::fill(wheel.begin(), wheel.end(), 0.5);
    }
  }
}

void BayesFilterLanes::update(const Signals& clean, const NoiseStep& draws) noexcept {
  if (!is_finite(clean, draws)) {
    return;
  }
  transition_.update(clean.vertical_acceleration, draws.acceleration);  // Eq. (7) to (13)
  measurement_.observe(clean, draws);                                   // Eq. (4) to (6)
  const double* const stay = transition_.contact_to_contact().data();
  const double* const takeoff = transition_.contact_to_air().data();
  const double* const landing = transition_.air_to_contact().data();
  const double* const fly = transition_.air_to_air().data();
  const std::uint32_t* const torque_index = torque_index_.data();
  const std::uint32_t* const acceleration_index = acceleration_index_.data();
  const std::size_t count = lanes();
  for (const Side side : {Side::left, Side::right}) {
    const double* const p_contact = measurement_.contact(side).data();
    const double* const p_no_contact = measurement_.no_contact(side).data();
    double* const contact = contact_[static_cast<std::size_t>(side)].data();
    double* const no_contact = no_contact_[static_cast<std::size_t>(side)].data();
    // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::uint32_t a = acceleration_index[lane];
      const std::uint32_t torque = torque_index[lane];
      const double bel = contact[lane];
      const double not_bel = no_contact[lane];
      // Eq. (2a), (2b) and (3)
      const double joint = p_contact[torque] * (stay[a] * bel + landing[a] * not_bel);
      const double not_joint = p_no_contact[torque] * (takeoff[a] * bel + fly[a] * not_bel);
      const double eta = joint + not_joint;
      // Divided before it is known whether by zero: a choice of values is vector code, a branch
      // not.
      const double corrected = joint / eta;
      const double not_corrected = not_joint / eta;
      contact[lane] = eta > 0.0 ? corrected : bel;
      no_contact[lane] = eta > 0.0 ? not_corrected : not_bel;
    }
  }
}

}  // namespace touchdown::experiments
