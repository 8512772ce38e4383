#pragma once

#include <memory>
#include <span>
#include <vector>

#include "estimator/numerics/axis.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

/// P(m_t | S_t = C) and P(m_t | S_t = ¬C), Eq. (6) of the paper, in 1/(N·m)² up to a factor common
/// to both.
struct Likelihoods {
  double contact = 1.0;
  double no_contact = 1.0;
};

/// P_τ(S_t = C | m_t), Eq. (14): 0.5 where both likelihoods are zero.
inline double measurement_probability(const Likelihoods& p) noexcept {
  const double sum = p.contact + p.no_contact;
  return sum > 0.0 ? p.contact / sum : 0.5;
}

/// The measurement model as plain data, for files and plots. Both grids have wheel.count rows of
/// knee.count values, row after row: value (i, j) = grid[i * knee.count + j] belongs to wheel[i]
/// and knee[j].
struct LikelihoodGrids {
  Axis knee;
  Axis wheel;
  std::vector<double> contact;
  std::vector<double> no_contact;
};

/// P(contact) at every grid point with a flat prior: contact / (contact + no contact), one half
/// where both are zero.
std::vector<double> contact_probability(const LikelihoodGrids& grids);

/// The position of a measurement on the grid: the corner of its cell with the lower torques, and
/// the distance from there towards the next points, as fractions in [0, 1].
struct GridPosition {
  int cell = 0;
  double knee_weight = 0.0;
  double wheel_weight = 0.0;
};

/// The paper's measurement model: two densities over (knee torque, wheel torque) on one regular
/// grid, interpolated bilinearly. A torque outside the grid counts as the nearest torque on its
/// edge. The model is an immutable value: copies share the grids.
class MeasurementModel {
 public:
  /// Throws InputError unless both grids have the axes' sizes and hold finite values ≥ 0.
  explicit MeasurementModel(const LikelihoodGrids& grids);

  /// Both likelihoods at one measurement. Never fails; NaN counts as the lower end of its axis.
  [[nodiscard]] Likelihoods operator()(const TorqueSample& m) const noexcept {
    return at(place(m));
  }

  /// The operator in two parts, for loops over many measurements: the position on the grid, and
  /// the likelihoods there.
  [[nodiscard]] GridPosition place(const TorqueSample& m) const noexcept {
    const AxisPosition knee = knee_.place(m.knee);
    const AxisPosition wheel = wheel_.place(m.wheel);
    return {wheel.index * row_ + knee.index, knee.weight, wheel.weight};
  }
  [[nodiscard]] Likelihoods at(const GridPosition& position) const noexcept {
    const Likelihoods* const low = cells_ + position.cell;
    const Likelihoods* const high = low + row_;
    const double knee = position.knee_weight;
    const double wheel = position.wheel_weight;
    const double low_knee = 1.0 - knee;
    const double low_wheel = 1.0 - wheel;
    return {low_wheel * (low_knee * low[0].contact + knee * low[1].contact) +
                wheel * (low_knee * high[0].contact + knee * high[1].contact),
            low_wheel * (low_knee * low[0].no_contact + knee * low[1].no_contact) +
                wheel * (low_knee * high[0].no_contact + knee * high[1].no_contact)};
  }

  [[nodiscard]] const Axis& knee_axis() const noexcept { return knee_axis_; }
  [[nodiscard]] const Axis& wheel_axis() const noexcept { return wheel_axis_; }
  [[nodiscard]] LikelihoodGrids grids() const;

 private:
  Axis knee_axis_;
  Axis wheel_axis_;
  AxisLookup knee_;
  AxisLookup wheel_;
  int row_ = 0;
  // Both likelihoods side by side, so that one lookup touches as few cache lines as possible.
  std::shared_ptr<const std::vector<Likelihoods>> storage_;
  const Likelihoods* cells_ = nullptr;
};

}  // namespace touchdown
