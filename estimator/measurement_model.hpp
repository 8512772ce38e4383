#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "estimator/axis.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

/// P(m_t | S_t = C) and P(m_t | S_t = ¬C), Eq. (6) of the paper, in 1/(N·m)² up to a factor common
/// to both.
struct Likelihoods {
  double contact = 1.0;
  double no_contact = 1.0;
};

/// The measurement model as plain data, for files and plots. Both grids have wheel.count rows of
/// knee.count values, row after row: value (i, j) = grid[i * knee.count + j] belongs to wheel[i]
/// and knee[j].
struct LikelihoodGrids {
  Axis knee;
  Axis wheel;
  std::vector<double> contact;
  std::vector<double> no_contact;
};

/// Which axis a grid's rows follow, in data that comes from elsewhere.
enum class GridRows : int { wheel, knee };

/// Grids from axes given point by point and values in either axis order.
/// Throws InputError unless the axes are regular and the sizes agree.
LikelihoodGrids likelihood_grids(std::span<const double> knee_points,
                                 std::span<const double> wheel_points,
                                 std::span<const double> contact,
                                 std::span<const double> no_contact,
                                 GridRows rows = GridRows::wheel);

/// P(contact) at every grid point with a flat prior: contact / (contact + no contact), one half
/// where both are zero.
std::vector<double> contact_probability(const LikelihoodGrids& grids);

/// Where a measurement falls on the grid: the corner of its cell that has the lower torques, and
/// how far it is from there to the next points, as fractions in [0, 1].
struct GridPosition {
  int cell = 0;
  double knee_weight = 0.0;
  double wheel_weight = 0.0;
};

/// The paper's measurement model: two densities over (knee torque, wheel torque) on one regular
/// grid, interpolated bilinearly, extrapolated by constants (a torque outside the grid counts as
/// the nearest torque on its edge). An immutable value: copies share the grids.
class MeasurementModel {
 public:
  /// Throws InputError unless both grids have the axes' sizes and hold finite values ≥ 0.
  explicit MeasurementModel(const LikelihoodGrids& grids);

  /// Both likelihoods at one measurement. Never fails; NaN counts as the lower end of its axis.
  [[nodiscard]] Likelihoods operator()(const TorqueSample& m) const noexcept {
    return at(place(m));
  }

  /// The operator in two parts, for loops over many measurements: where on the grid, and what
  /// there.
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

/// Kernel widths along the two axes (N·m).
struct TorqueBandwidth {
  double knee = 0.0;
  double wheel = 0.0;

  bool operator==(const TorqueBandwidth&) const = default;
};

/// How a measurement model is fitted.
struct MeasurementFitConfig {
  /// Points of the grid along the knee's and the wheel's torque.
  int knee_count = 200;
  int wheel_count = 200;
  /// Ends of the axes (N·m): {lower, upper}. Without them the grid covers all samples and four
  /// bandwidths more (but nothing below zero if no sample is: absolute torques).
  std::optional<std::pair<double, double>> knee_range;
  std::optional<std::pair<double, double>> wheel_range;
  /// Scott's bandwidth is never taken smaller than this (N·m). Sensor noise that was not in the
  /// fitted data is what it stands for.
  TorqueBandwidth bandwidth_floor;
  /// Use these bandwidths instead of Scott's rule (N·m).
  std::optional<TorqueBandwidth> bandwidth;

  bool operator==(const MeasurementFitConfig&) const = default;
};

/// Fit f_C and f_¬C, Eq. (5) and (6), each with its own bandwidth, to samples from both legs that
/// went through `TorqueChannel`.
/// Throws InputError for fewer than two samples of either class and for samples that are not
/// finite.
MeasurementModel fit_measurement_model(std::span<const TorqueSample> contact,
                                       std::span<const TorqueSample> no_contact,
                                       const MeasurementFitConfig& config);

}  // namespace touchdown
